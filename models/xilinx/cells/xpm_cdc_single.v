// Synchroniser of one bit (UG953).
module xpm_cdc_single #(
  parameter DEST_SYNC_FF = 4, parameter INIT_SYNC_FF = 0, parameter SIM_ASSERT_CHK = 0, parameter SRC_INPUT_REG = 1,
  parameter VERSION = 0
)(input src_clk, input src_in, input dest_clk, output dest_out);
  xpm_cdc_array_single #(.DEST_SYNC_FF(DEST_SYNC_FF), .SRC_INPUT_REG(SRC_INPUT_REG), .WIDTH(1)) bits (
    .src_clk(src_clk), .src_in(src_in), .dest_clk(dest_clk), .dest_out(dest_out));
endmodule
