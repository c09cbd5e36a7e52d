// The port of a triggered sensor: passes its trigger on, unless a frame is under way, and its pixels, with
// their coordinates, one clock later. Companion of Camera (camera.h), which plays the sensor, too.
//
// The sensor answers a trigger with HEIGHT lines, and may leave clocks between two of them. Meanwhile
// `pixel_ce`, the enable of a BUFGCE, holds the clock of all that takes pixels.
module camera #(
    parameter int WIDTH = 640,
    parameter int HEIGHT = 480,
    parameter int PIXELS_PER_CLOCK = 1,  // 1, 2 or 4
    parameter int X_BITS = WIDTH > 1024 ? $clog2(WIDTH) : 10,
    parameter int Y_BITS = HEIGHT > 512 ? $clog2(HEIGHT) : 9
) (
    input  logic              clk,
    input  logic              rst,               // cuts the frame
    input  logic              por,               // frames are counted from 0 again
    input  logic              ena,               // a rise triggers
    input  logic              hold,              // triggers are dropped
    output logic              sensor_trigger,
    input  logic              sensor_valid,      // pixels of a line
    input  logic [       7:0] sensor_pixel,
    // verilator lint_off UNUSEDSIGNAL
    // Neighbours to the right, as many as come on a clock.
    input  logic [       7:0] sensor_pixel_1,
    input  logic [       7:0] sensor_pixel_2,
    input  logic [       7:0] sensor_pixel_3,
    // verilator lint_on UNUSEDSIGNAL
    output logic              pixel_ce,
    output logic              frame_ena,
    output logic [      31:0] frame_number,      // of the last frame that was triggered
    output logic [      31:0] dropped_triggers,
    output logic [       7:0] pixel,
    output logic [       7:0] pixel_1,
    output logic [       7:0] pixel_2,
    output logic [       7:0] pixel_3,
    output logic [X_BITS-1:0] pixel_x,
    output logic [Y_BITS-1:0] pixel_y
);
  localparam logic [X_BITS-1:0] LAST_COLUMN = X_BITS'(WIDTH - PIXELS_PER_CLOCK);
  localparam logic [Y_BITS-1:0] LAST_ROW = Y_BITS'(HEIGHT - 1);

  // `busy` from a trigger that counts to the last pixel.
  logic ena_before, busy;
  logic [31:0] triggers;
  wire rises = ena && !ena_before && !rst;
  wire starts = rises && !busy && !hold;
  wire [31:0] triggers_before = por ? '0 : triggers;
  wire [31:0] dropped_before = por ? '0 : dropped_triggers;
  always_ff @(posedge clk) begin
    ena_before       <= ena && !rst;
    sensor_trigger   <= starts;
    triggers         <= triggers_before + 32'(rises);
    dropped_triggers <= dropped_before + 32'(rises && !starts);
    if (starts) frame_number <= triggers_before;
  end

  // Pixels that do not come have no registers.
  localparam int COME = 8 * PIXELS_PER_CLOCK;
  wire [COME-1:0] comes = COME'({sensor_pixel_3, sensor_pixel_2, sensor_pixel_1, sensor_pixel});
  logic [COME-1:0] taken;
  assign {pixel_3, pixel_2, pixel_1, pixel} = 32'(taken);

  logic [X_BITS-1:0] column;
  logic [Y_BITS-1:0] row;
  wire line_ends = column == LAST_COLUMN;
  wire in_frame = frame_ena && busy;
  wire takes = sensor_valid && busy;  // ignores what a sensor still sends of a cut frame
  always_ff @(posedge clk) begin
    pixel_ce  <= rst || takes || !in_frame;
    frame_ena <= !rst && (takes || in_frame);
    busy      <= !rst && (starts || (busy && !(takes && line_ends && row == LAST_ROW)));
    if (starts) begin
      column <= '0;
      row    <= '0;
    end else if (takes) begin
      column <= line_ends ? '0 : column + X_BITS'(PIXELS_PER_CLOCK);
      if (line_ends) row <= row + 1'b1;
    end
    if (takes) begin
      taken   <= comes;
      pixel_x <= column;
      pixel_y <= row;
    end
  end
endmodule
