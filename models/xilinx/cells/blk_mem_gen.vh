// Block memory with native ports of one width (PG058), under the name of a version: `MARKERVP_BLK_MEM_GEN.
module `MARKERVP_BLK_MEM_GEN #(
  parameter C_FAMILY = "", parameter C_XDEVICEFAMILY = "", parameter C_ELABORATION_DIR = "", parameter C_INTERFACE_TYPE = 0,
  parameter C_AXI_TYPE = 1, parameter C_AXI_SLAVE_TYPE = 0, parameter C_USE_BRAM_BLOCK = 0, parameter C_ENABLE_32BIT_ADDRESS = 0,
  parameter C_CTRL_ECC_ALGO = "NONE", parameter C_HAS_AXI_ID = 0, parameter C_AXI_ID_WIDTH = 4, parameter C_MEM_TYPE = 0,
  parameter C_BYTE_SIZE = 9, parameter C_ALGORITHM = 1, parameter C_PRIM_TYPE = 1, parameter C_LOAD_INIT_FILE = 0,
  parameter C_INIT_FILE_NAME = "", parameter C_INIT_FILE = "", parameter C_USE_DEFAULT_DATA = 0, parameter C_DEFAULT_DATA = "0",
  parameter C_HAS_RSTA = 0, parameter C_RST_PRIORITY_A = "CE", parameter C_RSTRAM_A = 0, parameter C_INITA_VAL = "0",
  parameter C_HAS_ENA = 0, parameter C_HAS_REGCEA = 0, parameter C_USE_BYTE_WEA = 0, parameter C_WEA_WIDTH = 1,
  parameter C_WRITE_MODE_A = "WRITE_FIRST", parameter C_WRITE_WIDTH_A = 32, parameter C_READ_WIDTH_A = 32,
  parameter C_WRITE_DEPTH_A = 64, parameter C_READ_DEPTH_A = 64, parameter C_ADDRA_WIDTH = 6, parameter C_HAS_RSTB = 0,
  parameter C_RST_PRIORITY_B = "CE", parameter C_RSTRAM_B = 0, parameter C_INITB_VAL = "0", parameter C_HAS_ENB = 0,
  parameter C_HAS_REGCEB = 0, parameter C_USE_BYTE_WEB = 0, parameter C_WEB_WIDTH = 1, parameter C_WRITE_MODE_B = "WRITE_FIRST",
  parameter C_WRITE_WIDTH_B = 32, parameter C_READ_WIDTH_B = 32, parameter C_WRITE_DEPTH_B = 64, parameter C_READ_DEPTH_B = 64,
  parameter C_ADDRB_WIDTH = 6, parameter C_HAS_MEM_OUTPUT_REGS_A = 0, parameter C_HAS_MEM_OUTPUT_REGS_B = 0,
  parameter C_HAS_MUX_OUTPUT_REGS_A = 0, parameter C_HAS_MUX_OUTPUT_REGS_B = 0, parameter C_MUX_PIPELINE_STAGES = 0,
  parameter C_HAS_SOFTECC_INPUT_REGS_A = 0, parameter C_HAS_SOFTECC_OUTPUT_REGS_B = 0, parameter C_USE_SOFTECC = 0,
  parameter C_USE_ECC = 0, parameter C_EN_ECC_PIPE = 0, parameter C_READ_LATENCY_A = 1, parameter C_READ_LATENCY_B = 1,
  parameter C_HAS_INJECTERR = 0, parameter C_SIM_COLLISION_CHECK = "ALL", parameter C_COMMON_CLK = 0,
  parameter C_DISABLE_WARN_BHV_COLL = 0, parameter C_EN_SLEEP_PIN = 0, parameter C_USE_URAM = 0, parameter C_EN_RDADDRA_CHG = 0,
  parameter C_EN_RDADDRB_CHG = 0, parameter C_EN_DEEPSLEEP_PIN = 0, parameter C_EN_SHUTDOWN_PIN = 0, parameter C_EN_SAFETY_CKT = 0,
  parameter C_DISABLE_WARN_BHV_RANGE = 0, parameter C_COUNT_36K_BRAM = "", parameter C_COUNT_18K_BRAM = "",
  parameter C_EST_POWER_SUMMARY = ""
)(
  input clka, input rsta, input ena, input regcea, input [C_WEA_WIDTH-1:0] wea, input [C_ADDRA_WIDTH-1:0] addra,
  input [C_WRITE_WIDTH_A-1:0] dina, output [C_READ_WIDTH_A-1:0] douta,
  input clkb, input rstb, input enb, input regceb, input [C_WEB_WIDTH-1:0] web, input [C_ADDRB_WIDTH-1:0] addrb,
  input [C_WRITE_WIDTH_B-1:0] dinb, output [C_READ_WIDTH_B-1:0] doutb,
  input injectsbiterr, input injectdbiterr, input eccpipece, output sbiterr, output dbiterr,
  output [C_ADDRB_WIDTH-1:0] rdaddrecc, input sleep, input deepsleep, input shutdown, output rsta_busy, output rstb_busy,
  input s_aclk, input s_aresetn, input [C_AXI_ID_WIDTH-1:0] s_axi_awid, input [31:0] s_axi_awaddr, input [7:0] s_axi_awlen,
  input [2:0] s_axi_awsize, input [1:0] s_axi_awburst, input s_axi_awvalid, output s_axi_awready,
  input [C_WRITE_WIDTH_A-1:0] s_axi_wdata, input [C_WEA_WIDTH-1:0] s_axi_wstrb, input s_axi_wlast, input s_axi_wvalid,
  output s_axi_wready, output [C_AXI_ID_WIDTH-1:0] s_axi_bid, output [1:0] s_axi_bresp, output s_axi_bvalid, input s_axi_bready,
  input [C_AXI_ID_WIDTH-1:0] s_axi_arid, input [31:0] s_axi_araddr, input [7:0] s_axi_arlen, input [2:0] s_axi_arsize,
  input [1:0] s_axi_arburst, input s_axi_arvalid, output s_axi_arready, output [C_AXI_ID_WIDTH-1:0] s_axi_rid,
  output [C_WRITE_WIDTH_B-1:0] s_axi_rdata, output [1:0] s_axi_rresp, output s_axi_rlast, output s_axi_rvalid, input s_axi_rready,
  input s_axi_injectsbiterr, input s_axi_injectdbiterr, output s_axi_sbiterr, output s_axi_dbiterr,
  output [C_ADDRB_WIDTH-1:0] s_axi_rdaddrecc
);
  // Single port, simple and true dual port, ROM with one port and two.
  localparam WRITES_B = C_MEM_TYPE == 2, READS_A = C_MEM_TYPE != 1, READS_B = C_MEM_TYPE == 1 || C_MEM_TYPE == 2 || C_MEM_TYPE == 4;
  localparam WRITES_A = C_MEM_TYPE <= 2;
  localparam WIDTH = C_WRITE_WIDTH_A, LANE_A = C_USE_BYTE_WEA != 0 ? C_BYTE_SIZE : WIDTH, LANE_B = C_USE_BYTE_WEB != 0 ? C_BYTE_SIZE : WIDTH;
  localparam STAGES_A = C_HAS_MEM_OUTPUT_REGS_A + C_HAS_MUX_OUTPUT_REGS_A + C_MUX_PIPELINE_STAGES;
  localparam STAGES_B = C_HAS_MEM_OUTPUT_REGS_B + C_HAS_MUX_OUTPUT_REGS_B + C_MUX_PIPELINE_STAGES;

  if (C_INTERFACE_TYPE != 0) $error("blk_mem_gen is modelled with native ports only");
  if (C_USE_ECC != 0 || C_USE_SOFTECC != 0) $error("blk_mem_gen is modelled without ECC only");
  if (C_LOAD_INIT_FILE != 0) $error("blk_mem_gen is modelled without contents of a file only: give a module of its name that loads them");
  if (C_USE_DEFAULT_DATA != 0 && C_DEFAULT_DATA != "0") $error("blk_mem_gen is modelled with contents of 0 only");
  if ((READS_A && C_READ_WIDTH_A != WIDTH) || ((READS_B || WRITES_B) && C_READ_WIDTH_B != WIDTH) || (WRITES_B && C_WRITE_WIDTH_B != WIDTH))
    $error("blk_mem_gen is modelled with one width of all ports only");
  if ((C_HAS_RSTA != 0 && C_INITA_VAL != "0") || (C_HAS_RSTB != 0 && C_INITB_VAL != "0"))
    $error("blk_mem_gen is modelled with a reset to 0 only");

  reg [WIDTH-1:0] memory [0:C_WRITE_DEPTH_A-1];
  integer at;
  initial for (at = 0; at < C_WRITE_DEPTH_A; at = at + 1) memory[at] = 0;

  wire on_a = C_HAS_ENA == 0 || ena, on_b = C_HAS_ENB == 0 || enb;
  wire clear_a = C_HAS_RSTA != 0 && rsta, clear_b = C_HAS_RSTB != 0 && rstb;
  wire [C_WEA_WIDTH-1:0] write_a = WRITES_A && on_a ? wea : {C_WEA_WIDTH{1'b0}};
  wire [C_WEB_WIDTH-1:0] write_b = WRITES_B && on_b ? web : {C_WEB_WIDTH{1'b0}};
  reg [WIDTH-1:0] new_a, new_b, read_a, read_b;
  integer lane;
  initial begin
    read_a = 0;
    read_b = 0;
  end
  always @* begin
    new_a = memory[addra];
    for (lane = 0; lane < C_WEA_WIDTH; lane = lane + 1)
      if (write_a[lane]) new_a[lane*LANE_A +: LANE_A] = dina[lane*LANE_A +: LANE_A];
  end
  always @* begin
    new_b = memory[addrb];
    for (lane = 0; lane < C_WEB_WIDTH; lane = lane + 1)
      if (write_b[lane]) new_b[lane*LANE_B +: LANE_B] = dinb[lane*LANE_B +: LANE_B];
  end
  always @(posedge clka) begin
    if (|write_a) memory[addra] <= new_a;
    if (clear_a && STAGES_A == 0) read_a <= 0;
    else if (READS_A && on_a && !(C_WRITE_MODE_A == "NO_CHANGE" && |write_a))
      read_a <= C_WRITE_MODE_A == "WRITE_FIRST" ? new_a : memory[addra];
  end
  always @(posedge clkb) begin
    if (WRITES_B && |write_b) memory[addrb] <= new_b;
    if (clear_b && STAGES_B == 0) read_b <= 0;
    else if (READS_B && on_b && !(C_WRITE_MODE_B == "NO_CHANGE" && |write_b))
      read_b <= C_WRITE_MODE_B == "WRITE_FIRST" ? new_b : memory[addrb];
  end

  // Registers behind the memory: they have the enable of their own, if there is one, else that of the port.
  wire next_a = C_HAS_REGCEA != 0 ? regcea : on_a, next_b = C_HAS_REGCEB != 0 ? regceb : on_b;
  if (STAGES_A == 0) begin : direct_a
    assign douta = read_a;
  end else begin : registered_a
    reg [WIDTH-1:0] stages [0:STAGES_A-1];
    integer n;
    initial for (n = 0; n < STAGES_A; n = n + 1) stages[n] = 0;
    always @(posedge clka) begin
      if (next_a) begin
        stages[0] <= read_a;
        for (n = 1; n < STAGES_A; n = n + 1) stages[n] <= stages[n-1];
      end
      if (clear_a) stages[STAGES_A-1] <= 0;
    end
    assign douta = stages[STAGES_A-1];
  end
  if (STAGES_B == 0) begin : direct_b
    assign doutb = read_b;
  end else begin : registered_b
    reg [WIDTH-1:0] stages [0:STAGES_B-1];
    integer n;
    initial for (n = 0; n < STAGES_B; n = n + 1) stages[n] = 0;
    always @(posedge clkb) begin
      if (next_b) begin
        stages[0] <= read_b;
        for (n = 1; n < STAGES_B; n = n + 1) stages[n] <= stages[n-1];
      end
      if (clear_b) stages[STAGES_B-1] <= 0;
    end
    assign doutb = stages[STAGES_B-1];
  end

  assign {sbiterr, dbiterr, rsta_busy, rstb_busy} = 0;
  assign {s_axi_awready, s_axi_wready, s_axi_bvalid, s_axi_arready, s_axi_rvalid, s_axi_rlast, s_axi_sbiterr, s_axi_dbiterr} = 0;
  assign rdaddrecc = 0;
  assign s_axi_rdaddrecc = 0;
  assign {s_axi_bid, s_axi_bresp, s_axi_rid, s_axi_rresp} = 0;
  assign s_axi_rdata = 0;
endmodule
