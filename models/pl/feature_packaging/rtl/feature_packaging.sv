// Feature Packaging (thesis 4.4.3, ports of table B.6, and `done`). System clock.
//
// Corners and blobs wait in a buffer each; corners go first. Every change of `ready` lets the next word
// onto `feature` two clocks later, if one waits; the first word comes by itself. The buffers are
// distributed memory; a blob's two words are stored side by side, so one write does.
module feature_packaging #(
    parameter int BUFFER_DEPTH = 100,  // words in each of the two
    parameter int COUNT_BITS = $clog2(BUFFER_DEPTH + 1)
) (
    input  logic                  clk,
    input  logic                  ena,
    input  logic                  rst,
    input  logic [           1:0] ready,
    input  logic                  corner_in,        // the crossings' toggles
    input  logic [          31:0] corner_data,
    input  logic                  blob_in,
    input  logic [          31:0] blob_start,
    input  logic [          31:0] blob_end,
    input  logic                  done,             // the frame is finished, nothing is busy
    output logic [          31:0] feature,
    output logic                  corner_seen,      // the toggles as sampled last
    output logic                  blob_seen,
    output logic [COUNT_BITS-1:0] corner_count,     // words that wait
    output logic [COUNT_BITS-1:0] blob_count,
    output logic [          31:0] feature_overflow  // features that found no room
);
  localparam int PAIRS = (BUFFER_DEPTH + 1) / 2;
  localparam int CORNER_BITS = $clog2(BUFFER_DEPTH);
  localparam int PAIR_BITS = PAIRS > 1 ? $clog2(PAIRS) : 1;
  localparam logic [31:0] END_OF_FRAME = '1;

  wire corner_arrives = corner_in != corner_seen;
  wire blob_arrives = blob_in != blob_seen;
  wire corner_fits = corner_count < COUNT_BITS'(BUFFER_DEPTH);
  wire blob_fits = blob_count < COUNT_BITS'(BUFFER_DEPTH - 1);
  wire store_corner = ena && corner_arrives && corner_fits;
  wire store_blob = ena && blob_arrives && blob_fits;

  logic want, ended;
  logic [1:0] ready_before;
  wire show_corner = ena && want && corner_count != '0;
  wire show_blob = ena && want && !show_corner && blob_count != '0;
  wire show_end = ena && want && !show_corner && !show_blob
      && done && !ended && !corner_arrives && !blob_arrives;

  logic [31:0] corners[0:BUFFER_DEPTH-1];
  logic [CORNER_BITS-1:0] corner_read, corner_write;
  wire [31:0] oldest_corner = corners[corner_read];
  always_ff @(posedge clk) if (store_corner) corners[corner_write] <= corner_data;

  logic [63:0] blobs[0:PAIRS-1];
  logic [PAIR_BITS-1:0] blob_read, blob_write;
  logic second;  // the start of the oldest blob was shown
  wire [63:0] oldest_blob = blobs[blob_read];
  always_ff @(posedge clk) if (store_blob) blobs[blob_write] <= {blob_end, blob_start};

  function automatic logic [CORNER_BITS-1:0] after_corner(input logic [CORNER_BITS-1:0] place);
    after_corner = place == CORNER_BITS'(BUFFER_DEPTH - 1) ? '0 : place + 1'b1;
  endfunction
  function automatic logic [PAIR_BITS-1:0] after_blob(input logic [PAIR_BITS-1:0] place);
    after_blob = place == PAIR_BITS'(PAIRS - 1) ? '0 : place + 1'b1;
  endfunction

  always_ff @(posedge clk)
    if (rst) begin
      corner_read  <= '0;
      corner_write <= '0;
      corner_count <= '0;
      blob_read    <= '0;
      blob_write   <= '0;
      blob_count   <= '0;
      second       <= 1'b0;
    end else begin
      if (store_corner) corner_write <= after_corner(corner_write);
      if (show_corner) corner_read <= after_corner(corner_read);
      corner_count <= corner_count + COUNT_BITS'(store_corner) - COUNT_BITS'(show_corner);
      if (store_blob) blob_write <= after_blob(blob_write);
      if (show_blob && second) blob_read <= after_blob(blob_read);
      if (show_blob) second <= !second;
      blob_count <= blob_count + COUNT_BITS'({store_blob, 1'b0}) - COUNT_BITS'(show_blob);
    end

  always_ff @(posedge clk)
    if (rst) begin
      corner_seen      <= 1'b0;
      blob_seen        <= 1'b0;
      ready_before     <= 2'd0;
      want             <= 1'b1;
      ended            <= 1'b0;
      feature          <= '0;
      feature_overflow <= '0;
    end else if (ena) begin
      corner_seen  <= corner_in;
      blob_seen    <= blob_in;
      ready_before <= ready;
      want         <= ready != ready_before || (want && !(show_corner || show_blob || show_end));
      ended        <= done && (ended || show_end);
      if (show_corner) feature <= oldest_corner;
      if (show_blob) feature <= second ? oldest_blob[63:32] : oldest_blob[31:0];
      if (show_end) feature <= END_OF_FRAME;
      feature_overflow <= feature_overflow + 32'(corner_arrives && !corner_fits)
          + 32'(blob_arrives && !blob_fits);
    end
endmodule
