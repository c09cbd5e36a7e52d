// Synchroniser of an asynchronous reset: active at once, inactive after DEST_SYNC_FF clocks (UG953).
module xpm_cdc_async_rst #(
  parameter DEST_SYNC_FF = 4, parameter INIT_SYNC_FF = 0, parameter RST_ACTIVE_HIGH = 0, parameter VERSION = 0
)(input src_arst, input dest_clk, output dest_arst);
  wire active = RST_ACTIVE_HIGH != 0 ? src_arst : ~src_arst;
  reg [DEST_SYNC_FF-1:0] stages = 0;
  always @(posedge dest_clk or posedge active)
    if (active) stages <= {DEST_SYNC_FF{1'b1}};
    else stages <= {stages[DEST_SYNC_FF-2:0], 1'b0};
  assign dest_arst = RST_ACTIVE_HIGH != 0 ? stages[DEST_SYNC_FF-1] : ~stages[DEST_SYNC_FF-1];
endmodule
