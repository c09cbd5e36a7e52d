// Streams of 8 and of 1024 bits that pass inverted through a register, and one with all that may go along with data.
module streams (
    input  logic          clk,
    input  logic          rst_n,
    input  logic [   7:0] narrow_in_tdata,
    input  logic          narrow_in_tvalid,
    input  logic          narrow_in_tlast,
    output logic          narrow_in_tready,
    output logic [   7:0] narrow_out_tdata,
    output logic          narrow_out_tvalid,
    output logic          narrow_out_tlast,
    input  logic          narrow_out_tready,
    input  logic [1023:0] wide_in_tdata,
    input  logic [ 127:0] wide_in_tkeep,
    input  logic          wide_in_tvalid,
    input  logic          wide_in_tlast,
    output logic          wide_in_tready,
    output logic [1023:0] wide_out_tdata,
    output logic [ 127:0] wide_out_tkeep,
    output logic [ 127:0] wide_out_tstrb,
    output logic [  39:0] wide_out_tuser,
    output logic [   3:0] wide_out_tid,
    output logic [   2:0] wide_out_tdest,
    output logic          wide_out_tvalid,
    output logic          wide_out_tlast,
    input  logic          wide_out_tready,
    // Shows what goes along with the last beat.
    input  logic [1023:0] seen_tdata,
    input  logic [ 127:0] seen_tkeep,
    input  logic [ 127:0] seen_tstrb,
    input  logic [  39:0] seen_tuser,
    input  logic [   7:0] seen_tid,
    input  logic [   2:0] seen_tdest,
    input  logic          seen_tvalid,
    output logic          seen_tready,
    output logic [  39:0] user,
    output logic [   7:0] id,
    output logic [   2:0] dest,
    output logic [   7:0] strobes,
    output logic          top_byte_is_set
);
  assign narrow_in_tready = !narrow_out_tvalid || narrow_out_tready;
  assign wide_in_tready = !wide_out_tvalid || wide_out_tready;
  assign seen_tready = 1'b1;

  always_ff @(posedge clk)
    if (!rst_n) begin
      narrow_out_tvalid <= 1'b0;
      wide_out_tvalid <= 1'b0;
      wide_out_tuser <= '0;
    end else begin
      if (narrow_in_tready) begin
        narrow_out_tvalid <= narrow_in_tvalid;
        narrow_out_tdata  <= ~narrow_in_tdata;
        narrow_out_tlast  <= narrow_in_tlast;
      end
      if (wide_in_tready) begin
        wide_out_tvalid <= wide_in_tvalid;
        wide_out_tdata  <= ~wide_in_tdata;
        wide_out_tkeep  <= wide_in_tkeep;
        wide_out_tstrb  <= wide_in_tkeep & ~128'h2;
        wide_out_tlast  <= wide_in_tlast;
        if (wide_in_tvalid) begin
          wide_out_tuser <= wide_out_tuser + 40'h1_0000_0001;
          wide_out_tid   <= wide_out_tid + 4'd1;
          wide_out_tdest <= wide_out_tdest - 3'd1;
        end
      end
      if (seen_tvalid) begin
        user <= seen_tuser;
        id <= seen_tid;
        dest <= seen_tdest;
        strobes <= seen_tstrb[127:120] ^ seen_tkeep[127:120] ^ seen_tstrb[7:0];
        top_byte_is_set <= seen_tdata[1023:1016] != 8'd0;
      end
    end

  initial begin
    wide_out_tid = 4'd0;
    wide_out_tdest = 3'd0;
  end
endmodule
