// Blob Stream: the blobs of a frame as one packet (blob_stream.h), eight words each, and four at its
// end. Companion of the model, which says what is dropped.
module blob_stream #(
    parameter int FIFO_DEPTH = 512,  // words that wait, besides the output register
    parameter int CHECKSUM = 0,      // 1: the packet ends with a sum of its words
    parameter int COUNT_BITS = $clog2(FIFO_DEPTH + 1)
) (
    input  logic        clk,
    input  logic        rst,
    input  logic        frame_ena,       // of the camera
    input  logic [31:0] frame_number,
    input  logic [ 7:0] threshold,
    input  logic        idle,            // all blobs of the frame have left the labelling
    input  logic        blob_out,
    input  logic [31:0] extreme_0,
    input  logic [31:0] extreme_1,
    input  logic [31:0] extreme_2,
    input  logic [31:0] extreme_3,
    input  logic [31:0] extreme_4,
    input  logic [31:0] extreme_5,
    input  logic [31:0] extreme_6,
    input  logic [31:0] extreme_7,
    input  logic [31:0] label_overflow,  // pixels, since the last reset
    output logic [31:0] m_tdata,
    output logic [ 3:0] m_tkeep,
    output logic        m_tvalid,
    output logic        m_tlast,
    input  logic        m_tready,
    output logic        busy,
    output logic [COUNT_BITS-1:0] fifo_count,
    output logic [31:0] dropped_frames,  // for reports, since the last reset
    output logic [31:0] dropped_blobs
);
  localparam int BLOB_WORDS = 8;
  localparam logic [12:0] MOST_BLOBS = 13'd8191;
  localparam int PLACE_BITS = $clog2(FIFO_DEPTH);
  localparam logic [PLACE_BITS-1:0] LAST_PLACE = PLACE_BITS'(FIFO_DEPTH - 1);

  // A blob or the trailer on its way into the FIFO, a word a clock.
  logic sends, is_trailer, at_last;
  logic [2:0] place;
  logic waits, room;  // fifo_count is not 0, not FIFO_DEPTH
  logic fits, fits_behind;  // it has room for a blob, and for a word besides
  wire push = sends && room;
  wire sent_last = push && at_last;
  wire sender_free = !sends || sent_last;
  wire packet_ends = sent_last && is_trailer;

  wire free = !m_tvalid || m_tready;
  wire pop = free && waits;
  wire [COUNT_BITS-1:0] next_count = fifo_count + COUNT_BITS'(push) - COUNT_BITS'(pop);

  // The frame. The state before this clock decides on a new one, except for the end of the packet.
  logic frame_before, dropping, mixed, full;
  logic [31:0] number, lost, overflow_before;
  logic [7:0] threshold_used;
  logic [12:0] sent;
  wire begins = frame_ena && !frame_before;
  wire under_way = busy && !packet_ends;
  wire takes = m_tready && !m_tvalid && !waits;
  wire opens = begins && !under_way;
  wire is_busy = under_way || begins;
  wire drops = opens ? !takes : dropping;
  wire is_mixed = !opens && (mixed || begins);
  wire is_full = !opens && full;  // of blobs

  wire blob_comes = blob_out && is_busy && !drops;
  wire blob_fits = sends ? fits_behind : fits;
  wire takes_blob = blob_comes && !is_mixed && !is_full && sender_free && blob_fits;
  wire loses_blob = blob_comes && !takes_blob;
  wire ends = is_busy && !frame_ena && idle && !blob_out && sender_free;
  wire takes_trailer = ends && !drops;

  always_ff @(posedge clk) begin
    frame_before <= frame_ena;
    if (!under_way) begin  // sampled until a frame begins: fewer have to wait for `opens`
      number          <= frame_number;
      threshold_used  <= threshold;
      overflow_before <= label_overflow;
    end
    if (rst) begin
      busy           <= 1'b0;
      dropped_frames <= '0;
      dropped_blobs  <= '0;
      sends          <= 1'b0;
    end else begin
      busy     <= is_busy && !(ends && drops);
      dropping <= drops;
      mixed    <= is_mixed;
      if (begins && (under_way || !takes)) dropped_frames <= dropped_frames + 1'b1;
      if (loses_blob) dropped_blobs <= dropped_blobs + 1'b1;
      sends <= takes_blob || takes_trailer || !sender_free;
    end
    if (opens) begin
      sent <= 13'(takes_blob);
      full <= 1'b0;
      lost <= 32'(loses_blob);
    end else begin
      if (takes_blob) begin
        sent <= sent + 1'b1;
        full <= sent == MOST_BLOBS - 13'd1;
      end
      lost <= lost + (takes_trailer ? label_overflow - overflow_before : 32'(loses_blob));
    end
    // While nothing is sent these values do not matter.
    if (sender_free) begin
      place      <= 3'd0;
      at_last    <= 1'b0;
      is_trailer <= !blob_out;
    end else if (push) begin
      place   <= place + 1'b1;
      at_last <= place == (is_trailer ? 3'd2 : 3'd6);
    end
  end

  logic [32*BLOB_WORDS-1:0] blob;
  // What was pushed of the packet: turned by a bit with each word.
  logic [31:0] sum;
  wire [31:0] turned = {sum[30:0], sum[31]};
  wire [15:0] own = {7'd0, 1'b1, threshold_used};
  wire [31:0] last_word = CHECKSUM != 0 ? {turned[31:16] ^ turned[15:0] ^ own, own} : {24'd0, threshold_used};
  wire [127:0] trailer = {last_word, lost, 19'd0, sent, number};
  wire [31:0] word = is_trailer ? trailer[32*place[1:0]+:32] : blob[32*place+:32];
  always_ff @(posedge clk) begin
    if (opens) sum <= '0;
    else if (push) sum <= turned ^ word;
    if (sender_free)
      blob <= {extreme_7, extreme_6, extreme_5, extreme_4, extreme_3, extreme_2, extreme_1, extreme_0};
  end

  // The FIFO keeps TLAST beside each word.
  logic [32:0] fifo[0:FIFO_DEPTH-1];
  logic [PLACE_BITS-1:0] read, write;
  logic fifo_last, offered;
  assign m_tkeep  = 4'hF;
  assign m_tvalid = offered;
  assign m_tlast  = offered && fifo_last;
  always_ff @(posedge clk) begin
    if (push) fifo[write] <= {packet_ends, word};
    if (pop) {fifo_last, m_tdata} <= fifo[read];
    if (rst) begin
      read        <= '0;
      write       <= '0;
      fifo_count  <= '0;
      waits       <= 1'b0;
      room        <= 1'b1;
      fits        <= 1'b1;
      fits_behind <= FIFO_DEPTH > BLOB_WORDS;
      offered     <= 1'b0;
    end else begin
      if (push) write <= write == LAST_PLACE ? '0 : write + 1'b1;
      if (pop) read <= read == LAST_PLACE ? '0 : read + 1'b1;
      fifo_count  <= next_count;
      waits       <= next_count != '0;
      room        <= next_count != COUNT_BITS'(FIFO_DEPTH);
      fits        <= next_count <= COUNT_BITS'(FIFO_DEPTH - BLOB_WORDS);
      fits_behind <= next_count <= COUNT_BITS'(FIFO_DEPTH - BLOB_WORDS) && next_count != COUNT_BITS'(FIFO_DEPTH - BLOB_WORDS);
      if (free) offered <= pop;
    end
  end
endmodule
