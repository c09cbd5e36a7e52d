// Pixel Stream: each frame of grey pixels as one packet, four pixels a word. Companion of
// PixelStreamCore (core.h), which says when a frame is dropped or cut.
//
// With four pixels a clock a word comes on each edge, and the first one with the frame's begin.
module pixel_stream #(
    parameter int WIDTH = 640,
    parameter int HEIGHT = 480,
    parameter int FIFO_DEPTH = 64,  // words that wait, besides the output register
    parameter int PIXELS_PER_CLOCK = 1,  // 1, 2 or 4
    parameter int COUNT_BITS = $clog2(FIFO_DEPTH + 1)
) (
    input  logic        clk,
    input  logic        rst,
    input  logic        ena,             // of the frame
    input  logic [ 7:0] pixel,
    // verilator lint_off UNUSEDSIGNAL
    // Neighbours to the right, as many as come on a clock.
    input  logic [ 7:0] pixel_1,
    input  logic [ 7:0] pixel_2,
    input  logic [ 7:0] pixel_3,
    // verilator lint_on UNUSEDSIGNAL
    output logic [31:0] m_tdata,         // the leftmost pixel in bits 7:0
    output logic [ 3:0] m_tkeep,
    output logic        m_tvalid,
    output logic        m_tlast,
    input  logic        m_tready,
    output logic [31:0] dropped_frames,  // for reports, since the last reset
    output logic [31:0] cut_frames
);
  localparam int FRAME_WORDS = WIDTH * HEIGHT / 4;
  localparam int WORD_BITS = $clog2(FRAME_WORDS);
  localparam int PLACE_BITS = $clog2(FIFO_DEPTH);
  localparam logic [PLACE_BITS-1:0] LAST_PLACE = PLACE_BITS'(FIFO_DEPTH - 1);

  // Four pixels make a word. The newest come on top.
  localparam logic WHOLE = PIXELS_PER_CLOCK == 4;
  localparam int COME = 8 * PIXELS_PER_CLOCK;
  wire [COME-1:0] comes = COME'({pixel_3, pixel_2, pixel_1, pixel});
  logic ena_before;
  logic [31:8] gathered;
  logic [1:0] lane;
  wire starts = ena && !ena_before;
  wire [31:0] word = 32'({comes, gathered} >> (COME - 8));
  wire word_full = ena && (WHOLE || (!starts && lane == 2'(4 - PIXELS_PER_CLOCK)));
  always_ff @(posedge clk) begin
    ena_before <= ena;
    if (ena) begin
      gathered <= word[31:8];
      lane     <= starts ? 2'(PIXELS_PER_CLOCK) : lane + 2'(PIXELS_PER_CLOCK);
    end
  end

  // The packet of the frame: `passing` while its words are taken, `closing` if it lacks its end.
  logic passing, closing, first, last;
  logic [WORD_BITS-1:0] words;  // of it so far; `first` and `last`: of the word that comes next
  logic [COUNT_BITS-1:0] count;
  logic waits, room;            // count is not 0, not FIFO_DEPTH
  wire close = closing && room;
  wire takes = m_tready && !waits && !m_tvalid && !(closing && (WHOLE || !room));
  wire passes = starts ? takes : passing;
  wire cut = passes && ((ena_before && !ena) || (word_full && !(WHOLE && starts) && !room));
  wire store = word_full && (WHOLE && starts ? takes : passes && room);  // `takes` implies room
  wire at_last = last && !(WHOLE && starts);
  always_ff @(posedge clk)
    if (rst) begin
      passing        <= 1'b0;
      closing        <= 1'b0;
      dropped_frames <= '0;
      cut_frames     <= '0;
    end else begin
      passing <= passes && !cut && !(store && at_last);
      closing <= cut ? !first : closing && !room;
      if (starts && !takes) dropped_frames <= dropped_frames + 1'b1;
      if (cut) cut_frames <= cut_frames + 1'b1;
      if (starts) begin
        words <= WHOLE ? WORD_BITS'(1) : '0;
        first <= !WHOLE;
        last  <= FRAME_WORDS == (WHOLE ? 2 : 1);
      end else if (store) begin
        words <= words + 1'b1;
        first <= 1'b0;
        last  <= words == WORD_BITS'(FRAME_WORDS - 2);
      end
    end

  // The FIFO keeps TLAST beside each word. A packet that was cut ends with zeros.
  logic [32:0] fifo[0:FIFO_DEPTH-1];
  logic [PLACE_BITS-1:0] read, write;
  wire push = store || close;
  wire free = !m_tvalid || m_tready;
  wire pop = free && waits;
  wire [COUNT_BITS-1:0] next_count = count + COUNT_BITS'(push) - COUNT_BITS'(pop);
  logic fifo_last, offered;
  assign m_tkeep  = 4'hF;
  assign m_tvalid = offered;
  assign m_tlast  = offered && fifo_last;
  always_ff @(posedge clk) begin
    if (push) fifo[write] <= close ? {1'b1, 32'd0} : {at_last, word};
    if (pop) {fifo_last, m_tdata} <= fifo[read];
    if (rst) begin
      read    <= '0;
      write   <= '0;
      count   <= '0;
      waits   <= 1'b0;
      room    <= 1'b1;
      offered <= 1'b0;
    end else begin
      if (push) write <= write == LAST_PLACE ? '0 : write + 1'b1;
      if (pop) read <= read == LAST_PLACE ? '0 : read + 1'b1;
      count <= next_count;
      waits <= next_count != '0;
      room  <= next_count != COUNT_BITS'(FIFO_DEPTH);
      if (free) offered <= pop;
    end
  end
endmodule
