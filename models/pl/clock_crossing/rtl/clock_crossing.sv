// The pixel side of all three crossings, and the count of words that were lost. The two clocks come
// from one PLL and are constrained as related; a word crosses once every few clocks.
//
// The C++ model lets the system side sample first where edges of both clocks coincide. Registers do
// not: a word that is sampled and replaced at the same edge counts as lost here. That can happen only
// where the system clock is not faster than the pixel clock.
module clock_crossing (
    input  logic        clk,                // pixel clock
    input  logic        rst,
    input  logic        corner_out,
    input  logic [31:0] corner_data,
    input  logic        blob_out,
    input  logic [31:0] blob_start,
    input  logic [31:0] blob_end,
    input  logic        thresh_out,
    input  logic [31:0] thresh_data,
    input  logic        corner_seen,        // the toggles as the system side sampled them last
    input  logic        blob_seen,
    input  logic        binary_seen,
    output logic        corner_toggle,
    output logic [31:0] corner_word,
    output logic        blob_toggle,
    output logic [31:0] blob_word,
    output logic [31:0] blob_second_word,
    output logic        binary_toggle,
    output logic [31:0] binary_word,
    output logic [31:0] crossing_overflow   // words overwritten before they were seen
);
  logic corner_lost, blob_lost, binary_lost;

  crossing_register corner (
      .clk,
      .rst,
      .send(corner_out),
      .data(corner_data),
      .seen(corner_seen),
      .toggle(corner_toggle),
      .word(corner_word),
      .lost(corner_lost)
  );
  crossing_register #(
      .BITS(64)
  ) blob (
      .clk,
      .rst,
      .send(blob_out),
      .data({blob_end, blob_start}),
      .seen(blob_seen),
      .toggle(blob_toggle),
      .word({blob_second_word, blob_word}),
      .lost(blob_lost)
  );
  crossing_register binary (
      .clk,
      .rst,
      .send(thresh_out),
      .data(thresh_data),
      .seen(binary_seen),
      .toggle(binary_toggle),
      .word(binary_word),
      .lost(binary_lost)
  );

  always_ff @(posedge clk)
    if (rst) crossing_overflow <= '0;
    else
      crossing_overflow <= crossing_overflow + 32'(corner_lost) + 32'(blob_lost) + 32'(binary_lost);
endmodule
