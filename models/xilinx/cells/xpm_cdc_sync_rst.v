// Synchroniser of a synchronous reset (UG953).
module xpm_cdc_sync_rst #(
  parameter DEST_SYNC_FF = 4, parameter INIT = 1, parameter INIT_SYNC_FF = 0, parameter SIM_ASSERT_CHK = 0,
  parameter VERSION = 0
)(input src_rst, input dest_clk, output dest_rst);
  reg [DEST_SYNC_FF-1:0] stages = INIT != 0 ? {DEST_SYNC_FF{1'b1}} : {DEST_SYNC_FF{1'b0}};
  always @(posedge dest_clk) stages <= {stages[DEST_SYNC_FF-2:0], src_rst};
  assign dest_rst = stages[DEST_SYNC_FF-1];
endmodule
