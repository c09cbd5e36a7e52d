// A part with one interface of each kind, in the words of Vitis HLS: registers that start a copy from
// memory to memory, a stream that passes inverted, an interrupt, wires.
module everything (
    input  logic        ap_clk,
    input  logic        ap_rst_n,
    output logic        interrupt,
    // Registers: 00 start (write) and done (read, cleared by reading), 10 from, 18 to, 20 words.
    input  logic [ 5:0] s_axi_control_AWADDR,
    input  logic        s_axi_control_AWVALID,
    output logic        s_axi_control_AWREADY,
    input  logic [31:0] s_axi_control_WDATA,
    input  logic [ 3:0] s_axi_control_WSTRB,
    input  logic        s_axi_control_WVALID,
    output logic        s_axi_control_WREADY,
    output logic [ 1:0] s_axi_control_BRESP,
    output logic        s_axi_control_BVALID,
    input  logic        s_axi_control_BREADY,
    input  logic [ 5:0] s_axi_control_ARADDR,
    input  logic        s_axi_control_ARVALID,
    output logic        s_axi_control_ARREADY,
    output logic [31:0] s_axi_control_RDATA,
    output logic [ 1:0] s_axi_control_RRESP,
    output logic        s_axi_control_RVALID,
    input  logic        s_axi_control_RREADY,
    // Bursts of 4 words of 64 bits.
    output logic [63:0] m_axi_gmem_AWADDR,
    output logic [ 7:0] m_axi_gmem_AWLEN,
    output logic [ 2:0] m_axi_gmem_AWSIZE,
    output logic [ 1:0] m_axi_gmem_AWBURST,
    output logic        m_axi_gmem_AWVALID,
    input  logic        m_axi_gmem_AWREADY,
    output logic [63:0] m_axi_gmem_WDATA,
    output logic [ 7:0] m_axi_gmem_WSTRB,
    output logic        m_axi_gmem_WLAST,
    output logic        m_axi_gmem_WVALID,
    input  logic        m_axi_gmem_WREADY,
    input  logic [ 1:0] m_axi_gmem_BRESP,
    input  logic        m_axi_gmem_BVALID,
    output logic        m_axi_gmem_BREADY,
    output logic [63:0] m_axi_gmem_ARADDR,
    output logic [ 7:0] m_axi_gmem_ARLEN,
    output logic [ 2:0] m_axi_gmem_ARSIZE,
    output logic [ 1:0] m_axi_gmem_ARBURST,
    output logic        m_axi_gmem_ARVALID,
    input  logic        m_axi_gmem_ARREADY,
    input  logic [63:0] m_axi_gmem_RDATA,
    input  logic [ 1:0] m_axi_gmem_RRESP,
    input  logic        m_axi_gmem_RLAST,
    input  logic        m_axi_gmem_RVALID,
    output logic        m_axi_gmem_RREADY,
    // A stream through logic alone: TREADY goes back within the clock.
    input  logic [31:0] in_TDATA,
    input  logic        in_TVALID,
    input  logic        in_TLAST,
    output logic        in_TREADY,
    output logic [31:0] out_TDATA,
    output logic        out_TVALID,
    output logic        out_TLAST,
    input  logic        out_TREADY,
    input  logic [ 7:0] mode,
    output logic [ 7:0] leds
);
  logic [31:0] from, to;
  logic [31:0] source, target;  // of the present copy: the registers may change meanwhile
  logic [15:0] bursts;  // left
  logic [2:0] beats;    // received of the present one
  logic [63:0] words[4];
  logic done;
  enum logic [2:0] {IDLE, ADDRESS, READ, REQUEST, WRITE, ANSWER} state;

  assign out_TDATA  = ~in_TDATA;
  assign out_TVALID = in_TVALID;
  assign out_TLAST  = in_TLAST;
  assign in_TREADY  = out_TREADY;
  assign interrupt  = done;
  assign leds       = mode + 8'd1;

  // Registers: both halves of a write at once, one answer at a time.
  wire writes = s_axi_control_AWVALID && s_axi_control_WVALID && !s_axi_control_BVALID;
  wire reads = s_axi_control_ARVALID && !s_axi_control_RVALID;
  assign s_axi_control_AWREADY = writes;
  assign s_axi_control_WREADY  = writes;
  assign s_axi_control_BRESP   = 2'b00;
  assign s_axi_control_ARREADY = reads;
  assign s_axi_control_RRESP   = s_axi_control_RVALID && bad ? 2'b10 : 2'b00;
  logic bad;

  always_ff @(posedge ap_clk)
    if (!ap_rst_n) begin
      s_axi_control_BVALID <= 1'b0;
      s_axi_control_RVALID <= 1'b0;
      bad <= 1'b0;
      from <= '0;
      to <= '0;
    end else begin
      if (s_axi_control_BREADY) s_axi_control_BVALID <= 1'b0;
      if (writes) begin
        s_axi_control_BVALID <= 1'b1;
        if (s_axi_control_AWADDR[5:2] == 4'h4)
          for (int i = 0; i < 4; ++i)
            if (s_axi_control_WSTRB[i]) from[8*i+:8] <= s_axi_control_WDATA[8*i+:8];
        if (s_axi_control_AWADDR[5:2] == 4'h6) to <= s_axi_control_WDATA;
      end
      if (s_axi_control_RREADY) s_axi_control_RVALID <= 1'b0;
      if (reads) begin
        s_axi_control_RVALID <= 1'b1;
        bad <= s_axi_control_ARADDR[5:2] == 4'hF;
        case (s_axi_control_ARADDR[5:2])
          4'h0: s_axi_control_RDATA <= {30'b0, done, 1'b0};
          4'h4: s_axi_control_RDATA <= from;
          4'h6: s_axi_control_RDATA <= to;
          default: s_axi_control_RDATA <= 32'hDEAD_BEEF;
        endcase
      end
    end

  assign m_axi_gmem_ARADDR  = {32'b0, source + {11'b0, counted, 5'b0}};
  assign m_axi_gmem_AWADDR  = {32'b0, target + {11'b0, counted, 5'b0}};
  assign m_axi_gmem_ARLEN   = 8'd3;
  assign m_axi_gmem_AWLEN   = 8'd3;
  assign m_axi_gmem_ARSIZE  = 3'd3;
  assign m_axi_gmem_AWSIZE  = 3'd3;
  assign m_axi_gmem_ARBURST = 2'b01;
  assign m_axi_gmem_AWBURST = 2'b01;
  assign m_axi_gmem_ARVALID = state == ADDRESS;
  assign m_axi_gmem_RREADY  = state == READ;
  assign m_axi_gmem_AWVALID = state == REQUEST;
  assign m_axi_gmem_WVALID  = state == WRITE;
  assign m_axi_gmem_WDATA   = words[beats[1:0]];
  assign m_axi_gmem_WSTRB   = 8'hFF;
  assign m_axi_gmem_WLAST   = beats == 3'd3;
  assign m_axi_gmem_BREADY  = state == ANSWER;
  logic [15:0] counted;

  always_ff @(posedge ap_clk)
    if (!ap_rst_n) begin
      state   <= IDLE;
      done    <= 1'b0;
      counted <= '0;
      bursts  <= '0;
      beats   <= '0;
    end else begin
      if (reads && s_axi_control_ARADDR[5:2] == 4'h0) done <= 1'b0;
      case (state)
        IDLE:
        if (writes && s_axi_control_AWADDR[5:2] == 4'h0) begin
          state   <= ADDRESS;
          bursts  <= s_axi_control_WDATA[31:16];
          counted <= '0;
          source  <= from;
          target  <= to;
        end
        ADDRESS: if (m_axi_gmem_ARREADY) state <= READ;
        READ:
        if (m_axi_gmem_RVALID) begin
          words[beats[1:0]] <= m_axi_gmem_RDATA;
          beats <= m_axi_gmem_RLAST ? '0 : beats + 1'b1;
          if (m_axi_gmem_RLAST) state <= REQUEST;
        end
        REQUEST: if (m_axi_gmem_AWREADY) state <= WRITE;
        WRITE:
        if (m_axi_gmem_WREADY) begin
          beats <= m_axi_gmem_WLAST ? '0 : beats + 1'b1;
          if (m_axi_gmem_WLAST) state <= ANSWER;
        end
        default:
        if (m_axi_gmem_BVALID) begin
          counted <= counted + 1'b1;
          state   <= counted + 1'b1 == bursts ? IDLE : ADDRESS;
          if (counted + 1'b1 == bursts) done <= 1'b1;
        end
      endcase
    end
endmodule
