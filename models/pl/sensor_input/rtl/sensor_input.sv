// Sensor Input (thesis 4.3.2, ports of table B.7): reads the stored image from port B of the BRAM and
// plays it as a camera sensor would, one pixel per pixel clock. The BRAM's output register is the
// register of `pixel`.
module sensor_input #(
    parameter int WIDTH = 640,
    parameter int HEIGHT = 480,
    parameter int ADDRESS_BITS = $clog2(WIDTH * HEIGHT),
    parameter int X_BITS = WIDTH > 1024 ? $clog2(WIDTH) : 10,
    parameter int Y_BITS = HEIGHT > 512 ? $clog2(HEIGHT) : 9
) (
    input  logic                    clk,
    input  logic                    rst,
    input  logic                    ena,        // a rise starts a frame; ignored while one runs
    output logic                    bram_en,
    output logic [ADDRESS_BITS-1:0] bram_addr,
    input  logic [             7:0] bram_dout,
    output logic                    frame_ena,
    output logic [             7:0] pixel,
    output logic [      X_BITS-1:0] pixel_x,
    output logic [      Y_BITS-1:0] pixel_y
);
  localparam logic [X_BITS-1:0] LAST_COLUMN = X_BITS'(WIDTH - 1);
  localparam logic [Y_BITS-1:0] LAST_ROW = Y_BITS'(HEIGHT - 1);

  logic running, ena_before;
  logic [X_BITS-1:0] column;
  logic [Y_BITS-1:0] row;

  assign bram_en = running && !rst;
  assign pixel = bram_dout;

  wire start = ena && !ena_before && !running;
  always_ff @(posedge clk)
    if (rst) begin
      running    <= 1'b0;
      ena_before <= 1'b0;
      frame_ena  <= 1'b0;
    end else begin
      ena_before <= ena;
      frame_ena  <= running;
      if (start) begin
        running   <= 1'b1;
        bram_addr <= '0;
        column    <= '0;
        row       <= '0;
      end else if (running) begin
        pixel_x   <= column;
        pixel_y   <= row;
        bram_addr <= bram_addr + 1'b1;
        column    <= column == LAST_COLUMN ? '0 : column + 1'b1;
        if (column == LAST_COLUMN) begin
          row     <= row + 1'b1;
          running <= row != LAST_ROW;
        end
      end
    end
endmodule
