// A stream that waits for TREADY, and breaks one rule of `fault` meanwhile; 0 breaks none.
module faulty_stream (
    input  logic        clk,
    input  logic        rst_n,
    input  logic [ 2:0] fault,
    output logic [31:0] m_axis_tdata,
    output logic [ 3:0] m_axis_tkeep,
    output logic [ 0:0] m_axis_tuser,
    output logic        m_axis_tvalid,
    output logic        m_axis_tlast,
    input  logic        m_axis_tready
);
  logic [3:0] waited;
  wire now = waited == 4'd3;

  always_ff @(posedge clk)
    if (!rst_n || m_axis_tready) waited <= 4'd0;
    else if (waited != 4'd15) waited <= waited + 4'd1;

  assign m_axis_tvalid = (rst_n || fault == 3'd7) && !(fault == 3'd1 && now);
  assign m_axis_tdata  = {31'd5, fault == 3'd2 && now};
  assign m_axis_tlast  = fault != 3'd6 && !(fault == 3'd3 && now);
  assign m_axis_tkeep  = fault == 3'd6 || (fault == 3'd4 && now) ? 4'h3 : 4'hF;
  assign m_axis_tuser  = fault == 3'd5 && now;
endmodule
