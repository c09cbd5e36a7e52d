// Tells when a frame is completely processed: `busy` falls when the pipeline has drained and the blob
// detection is idle; `done` waits for a word that leaves in that very clock, too.
module frame_status (
    input  logic clk,
    input  logic rst,
    input  logic frame_ena,
    input  logic idle,
    input  logic corner_out,
    input  logic blob_out,
    output logic busy,
    output logic done
);
  localparam logic [3:0] DRAIN_CLOCKS = 4'd15;  // after the last pixel: covers every module's pipeline

  logic [3:0] drain;
  logic started;
  always_ff @(posedge clk)
    if (rst) begin
      drain   <= DRAIN_CLOCKS;
      started <= 1'b0;
    end else if (frame_ena) begin
      drain   <= DRAIN_CLOCKS;
      started <= 1'b1;
    end else if (started && drain != 4'd0) begin
      drain <= drain - 4'd1;
    end

  assign busy = started && (drain != 4'd0 || !idle || frame_ena);
  assign done = started && !busy && !corner_out && !blob_out;
endmodule
