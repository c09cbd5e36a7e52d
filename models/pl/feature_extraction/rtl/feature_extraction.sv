// The feature extraction with its data bridge, wired as the thesis' figure E.1: pixels from a block
// memory in, feature words and the binary image out. What connects it to the PS (GPIO, DMA) is outside.
module feature_extraction #(
    parameter int WIDTH = 640,       // a multiple of 32, at most 2048
    parameter int HEIGHT = 480,      // at most 2048; WIDTH * HEIGHT a multiple of 1024
    parameter int THRESHOLD = 30,    // of corner detection
    parameter int LEAN = 0,          // 1: one FAST module instead of nine
    parameter int LABELS = 128,
    parameter int MINIMUM_SIDE = 24,
    parameter int BUFFER_DEPTH = 100,
    parameter int FIFO_DEPTH = 64,
    parameter int BURST_WORDS = 32
) (
    (* X_INTERFACE_PARAMETER = "ASSOCIATED_BUSIF image:binary" *)
    input  logic        system_clk,
    input  logic        pixel_clk,
    input  logic        por,
    input  logic [31:0] gpio_in,
    input  logic [31:0] image_tdata,
    input  logic        image_tvalid,
    output logic        image_tready,
    output logic [31:0] binary_tdata,
    output logic [ 3:0] binary_tkeep,
    output logic        binary_tvalid,
    output logic        binary_tlast,
    input  logic        binary_tready,
    output logic [31:0] feature,
    output logic        frame_ena,         // of the sensor; for simulations and reports, as what follows
    output logic [ 7:0] active_threshold,
    output logic [31:0] label_overflow,
    output logic [31:0] crossing_overflow,
    output logic [31:0] feature_overflow,
    output logic [31:0] bridge_overflow
);
  localparam int WORD_BITS = $clog2(WIDTH * HEIGHT / 4);
  localparam int X_BITS = WIDTH > 1024 ? $clog2(WIDTH) : 10;
  localparam int Y_BITS = HEIGHT > 512 ? $clog2(HEIGHT) : 9;

  logic ena, rst, wr_en, wr_thresh;
  logic [1:0] ready;
  logic [7:0] threshold;
  control_block control_block (
      .gpio_in,
      .por,
      .ena,
      .rst_out(rst),
      .ready,
      .wr_en,
      .wr_thresh,
      .threshold
  );

  logic bram_we, bram_en;
  logic [WORD_BITS-1:0] bram_addr_a;
  logic [WORD_BITS+1:0] bram_addr_b;
  logic [31:0] bram_din;
  logic [7:0] bram_dout;
  axi_image_store #(
      .ADDRESS_BITS(WORD_BITS)
  ) axi_image_store (
      .clk(system_clk),
      .ena(wr_en),
      .rst,
      .m_tdata(image_tdata),
      .m_tvalid(image_tvalid),
      .m_tready(image_tready),
      .bram_we,
      .bram_addr(bram_addr_a),
      .bram_din
  );
  frame_memory #(
      .PIXELS(WIDTH * HEIGHT)
  ) bram (
      .clk_a(system_clk),
      .we_a(bram_we),
      .addr_a(bram_addr_a),
      .din_a(bram_din),
      .clk_b(pixel_clk),
      .en_b(bram_en),
      .addr_b(bram_addr_b),
      .dout_b(bram_dout)
  );

  logic [7:0] pixel;
  logic [X_BITS-1:0] pixel_x;
  logic [Y_BITS-1:0] pixel_y;
  sensor_input #(
      .WIDTH (WIDTH),
      .HEIGHT(HEIGHT),
      .ADDRESS_BITS(WORD_BITS + 2)
  ) sensor_input (
      .clk(pixel_clk),
      .rst,
      .ena,
      .bram_en,
      .bram_addr(bram_addr_b),
      .bram_dout,
      .frame_ena,
      .pixel,
      .pixel_x,
      .pixel_y
  );

  logic corner_out;
  logic [31:0] corner_data;
  corner_detection #(
      .WIDTH(WIDTH),
      .THRESHOLD(THRESHOLD),
      .LEAN(LEAN),
      .X_BITS(X_BITS),
      .Y_BITS(Y_BITS)
  ) corner_detection (
      .clk(pixel_clk),
      .ena(frame_ena),
      .rst,
      .pixel,
      .x(pixel_x),
      .y(pixel_y),
      .corner_out,
      .corner_data
  );

  logic binary_ena, binary_out, thresh_out;
  logic [X_BITS-1:0] binary_x;
  logic [Y_BITS-1:0] binary_y;
  logic [31:0] thresh_data;
  /* verilator lint_off UNUSEDSIGNAL */
  logic busy;  // for simulations
  /* verilator lint_on UNUSEDSIGNAL */
  /* verilator lint_off PINCONNECTEMPTY */
  // One pixel comes on a clock.
  global_threshold #(
      .WIDTH (WIDTH),
      .HEIGHT(HEIGHT)
  ) global_threshold (
      .clk(pixel_clk),
      .por,
      .rst,
      .frame_ena,
      .wr_thresh,
      .threshold,
      .pixel,
      .pixel_1(8'd0),
      .pixel_2(8'd0),
      .pixel_3(8'd0),
      .x(pixel_x),
      .y(pixel_y),
      .binary_ena,
      .binary_out,
      .binary_out_1(),
      .binary_out_2(),
      .binary_out_3(),
      .binary_x,
      .binary_y,
      .thresh_out,
      .thresh_data,
      .active_threshold
  );
  /* verilator lint_on PINCONNECTEMPTY */

  logic blob_out, idle;
  logic [31:0] blob_start, blob_end;
  blob_detection #(
      .WIDTH(WIDTH),
      .LABELS(LABELS),
      .MINIMUM_SIDE(MINIMUM_SIDE),
      .X_BITS(X_BITS),
      .Y_BITS(Y_BITS)
  ) blob_detection (
      .clk(pixel_clk),
      .ena(binary_ena),
      .rst,
      .pixel(binary_out),
      .x(binary_x),
      .y(binary_y),
      .blob_out,
      .blob_start,
      .blob_end,
      .idle,
      .label_overflow
  );

  logic done;
  frame_status frame_status (
      .clk(pixel_clk),
      .rst,
      .frame_ena,
      .idle,
      .corner_out,
      .blob_out,
      .busy,
      .done
  );

  logic corner_toggle, blob_toggle, binary_toggle, corner_seen, blob_seen, binary_seen;
  logic [31:0] corner_word, blob_word, blob_second_word, binary_word;
  clock_crossing clock_crossing (
      .clk(pixel_clk),
      .rst,
      .corner_out,
      .corner_data,
      .blob_out,
      .blob_start,
      .blob_end,
      .thresh_out,
      .thresh_data,
      .corner_seen,
      .blob_seen,
      .binary_seen,
      .corner_toggle,
      .corner_word,
      .blob_toggle,
      .blob_word,
      .blob_second_word,
      .binary_toggle,
      .binary_word,
      .crossing_overflow
  );

  /* verilator lint_off PINCONNECTEMPTY */
  feature_packaging #(
      .BUFFER_DEPTH(BUFFER_DEPTH)
  ) feature_packaging (
      .clk(system_clk),
      .ena(1'b1),
      .rst,
      .ready,
      .corner_in(corner_toggle),
      .corner_data(corner_word),
      .blob_in(blob_toggle),
      .blob_start(blob_word),
      .blob_end(blob_second_word),
      .done,
      .feature,
      .corner_seen,
      .blob_seen,
      .corner_count(),  // for simulations
      .blob_count(),
      .feature_overflow
  );
  axi_threshold_bridge #(
      .FIFO_DEPTH (FIFO_DEPTH),
      .BURST_WORDS(BURST_WORDS)
  ) axi_threshold_bridge (
      .clk(system_clk),
      .ena(1'b1),
      .rst,
      .thresh_in(binary_toggle),
      .thresh_data(binary_word),
      .m_tdata(binary_tdata),
      .m_tkeep(binary_tkeep),
      .m_tvalid(binary_tvalid),
      .m_tlast(binary_tlast),
      .m_tready(binary_tready),
      .thresh_seen(binary_seen),
      .fifo_count(),
      .bridge_overflow
  );
  /* verilator lint_on PINCONNECTEMPTY */
endmodule
