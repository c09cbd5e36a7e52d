// An AXI4-Stream from the pixel clock to the clock of a DMA: a FIFO in distributed memory, whose counts cross
// in Gray code, each through two registers. Companion of StreamCrossing (stream_crossing.h), which says when a
// packet may begin.
//
// `rst` belongs to the pixel clock and lasts for some edges of both: what is under way then is dropped.
module stream_crossing #(
    parameter int DEPTH = 16  // words that may be on their way: 8, 16, 32, 64, 128 or 256
) (
    input  logic        clk,       // pixel clock
    input  logic        rst,
    input  logic [31:0] s_tdata,
    input  logic        s_tvalid,
    input  logic        s_tlast,
    output logic        s_tready,
    input  logic        m_clk,     // of the receiver
    output logic [31:0] m_tdata,
    output logic [ 3:0] m_tkeep,
    output logic        m_tvalid,
    output logic        m_tlast,
    input  logic        m_tready
);
  localparam int PLACE_BITS = $clog2(DEPTH);
  localparam int BITS = PLACE_BITS + 1;  // of a count: a full FIFO is no empty one
  localparam logic [BITS-1:0] ONE = BITS'(1), TURN = BITS'(3) << (BITS - 2);

  function automatic logic [BITS-1:0] gray(input logic [BITS-1:0] count);
    gray = count ^ (count >> 1);
  endfunction
  function automatic logic [BITS-1:0] binary(input logic [BITS-1:0] code);
    for (int i = 0; i < BITS; i++) binary[i] = ^(code >> i);
  endfunction

  logic [32:0] memory[0:DEPTH-1];  // TLAST beside each word

  // The side that takes words.
  logic [BITS-1:0] written = '0, written_gray = '0, read_gray = '0;
  (* ASYNC_REG = "TRUE" *) logic [BITS-1:0] read_first = '0, read_seen = '0;
  (* ASYNC_REG = "TRUE" *) logic ready_first = 1'b0, ready_seen = 1'b0;
  logic flush = 1'b0, in_packet = 1'b0;
  wire [BITS-1:0] written_next = written + ONE;
  wire empty = written_gray == read_seen;
  wire full = written_gray == (read_seen ^ TURN);  // one turn ahead: the two upper bits differ
  assign s_tready = !flush && (in_packet ? !full : empty && ready_seen);
  always_ff @(posedge clk) begin
    read_first  <= read_gray;
    read_seen   <= read_first;
    ready_first <= m_tready;
    ready_seen  <= ready_first;
    flush       <= rst;
    if (rst) in_packet <= 1'b0;
    else if (s_tvalid && s_tready) begin
      memory[written[PLACE_BITS-1:0]] <= {s_tlast, s_tdata};
      written      <= written_next;
      written_gray <= gray(written_next);
      in_packet    <= !s_tlast;
    end
  end

  // The side that gives them.
  logic [BITS-1:0] read = '0;
  (* ASYNC_REG = "TRUE" *) logic [BITS-1:0] written_first = '0, written_seen = '0;
  (* ASYNC_REG = "TRUE" *) logic flush_first = 1'b0, flush_seen = 1'b0;
  wire [BITS-1:0] read_next = flush_seen ? binary(written_seen) : read + ONE;
  wire last;
  assign {last, m_tdata} = memory[read[PLACE_BITS-1:0]];
  assign m_tkeep  = 4'hF;
  assign m_tvalid = !flush_seen && written_seen != read_gray;
  assign m_tlast  = m_tvalid && last;
  always_ff @(posedge m_clk) begin
    written_first <= written_gray;
    written_seen  <= written_first;
    flush_first   <= flush;
    flush_seen    <= flush_first;
    if (flush_seen || (m_tvalid && m_tready)) begin
      read      <= read_next;
      read_gray <= gray(read_next);
    end
  end
endmodule
