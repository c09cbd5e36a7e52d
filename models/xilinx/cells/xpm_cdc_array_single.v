// Synchronisers of several bits that do not belong together (UG953).
module xpm_cdc_array_single #(
  parameter DEST_SYNC_FF = 4, parameter INIT_SYNC_FF = 0, parameter SIM_ASSERT_CHK = 0, parameter SRC_INPUT_REG = 1,
  parameter VERSION = 0, parameter WIDTH = 2
)(input src_clk, input [WIDTH-1:0] src_in, input dest_clk, output [WIDTH-1:0] dest_out);
  reg [WIDTH-1:0] sent = 0;
  reg [DEST_SYNC_FF*WIDTH-1:0] stages = 0;
  always @(posedge src_clk) sent <= src_in;
  wire [WIDTH-1:0] crossing = SRC_INPUT_REG != 0 ? sent : src_in;
  always @(posedge dest_clk) stages <= {stages[(DEST_SYNC_FF-1)*WIDTH-1:0], crossing};
  assign dest_out = stages[DEST_SYNC_FF*WIDTH-1 -: WIDTH];
endmodule
