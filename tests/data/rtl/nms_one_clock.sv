// Non-maximum suppression in one clock: the thesis' first form (4.3.4.4), of which it says that it works up to 36.63 MHz. Its source
// was never published. Between the same registers as corner_detection.sv has (what nine FAST modules found, and the corner's word)
// this is one loop over nine strengths, as a process of VHDL would say it: the greatest so far, the first of equal ones. There is a
// corner where the centre is the greatest.
module nms_one_clock (
    input  logic            clk,
    input  logic            rst,
    input  logic            whole,       // the window lies within the frame
    input  logic [     8:0] contiguous,
    input  logic [9*12-1:0] strengths,
    input  logic [     1:0] direction,
    input  logic [     9:0] x,
    input  logic [     8:0] y,
    output logic            corner_out,
    output logic [    31:0] corner_data
);
  logic whole_now;
  logic [8:0] contiguous_now, y_now;
  logic [9*12-1:0] strengths_now;
  logic [1:0] direction_now;
  logic [9:0] x_now;

  logic [11:0] score, greatest;
  logic [3:0] place;
  always_comb begin
    score = '0;
    greatest = '0;
    place = 4'd15;
    for (int n = 0; n < 9; n++) begin
      score = contiguous_now[n] ? strengths_now[n*12+:12] : 12'd0;
      if (score > greatest) begin
        greatest = score;
        place = n[3:0];
      end
    end
  end
  wire is_corner = whole_now && place == 4'd4;

  always_ff @(posedge clk) begin
    whole_now <= whole && !rst;
    contiguous_now <= contiguous;
    strengths_now <= strengths;
    direction_now <= direction;
    {x_now, y_now} <= {x, y};
    corner_out <= is_corner && !rst;
    if (is_corner) corner_data <= {1'b1, greatest[11:2], direction_now, y_now, x_now};
  end
endmodule
