// AXI Threshold Bridge (thesis 4.4.2, ports of table B.5): sends the binary image to the PS. A full
// FIFO drops the newest word and counts it. System clock.
module axi_threshold_bridge #(
    parameter int FIFO_DEPTH = 64,   // words that wait, besides the output register
    parameter int BURST_WORDS = 32,  // TLAST comes with the last
    parameter int COUNT_BITS = $clog2(FIFO_DEPTH + 1)
) (
    input  logic                  clk,
    input  logic                  ena,
    input  logic                  rst,
    input  logic                  thresh_in,       // the crossing's toggle
    input  logic [          31:0] thresh_data,
    output logic [          31:0] m_tdata,
    output logic [           3:0] m_tkeep,
    output logic                  m_tvalid,
    output logic                  m_tlast,
    input  logic                  m_tready,
    output logic                  thresh_seen,     // the toggle as sampled last
    output logic [COUNT_BITS-1:0] fifo_count,
    output logic [          31:0] bridge_overflow
);
  localparam int PLACE_BITS = FIFO_DEPTH > 1 ? $clog2(FIFO_DEPTH) : 1;
  localparam int BURST_BITS = BURST_WORDS > 1 ? $clog2(BURST_WORDS) : 1;
  localparam logic [PLACE_BITS-1:0] LAST_PLACE = PLACE_BITS'(FIFO_DEPTH - 1);
  localparam logic [BURST_BITS-1:0] LAST_WORD = BURST_BITS'(BURST_WORDS - 1);

  logic [31:0] fifo[0:FIFO_DEPTH-1];
  logic [PLACE_BITS-1:0] read, write;
  logic [BURST_BITS-1:0] in_packet;

  wire arrives = ena && thresh_in != thresh_seen;
  wire fits = fifo_count < COUNT_BITS'(FIFO_DEPTH);
  wire store = arrives && fits;
  wire free = !m_tvalid || m_tready;
  wire offer = ena && free && fifo_count != '0;

  assign m_tkeep = 4'hF;

  always_ff @(posedge clk) begin
    if (store) fifo[write] <= thresh_data;
    if (offer) m_tdata <= fifo[read];
  end

  always_ff @(posedge clk)
    if (rst) begin
      read            <= '0;
      write           <= '0;
      fifo_count      <= '0;
      in_packet       <= '0;
      m_tvalid        <= 1'b0;
      m_tlast         <= 1'b0;
      thresh_seen     <= 1'b0;
      bridge_overflow <= '0;
    end else begin
      if (store) write <= write == LAST_PLACE ? '0 : write + 1'b1;
      if (offer) read <= read == LAST_PLACE ? '0 : read + 1'b1;
      fifo_count <= fifo_count + COUNT_BITS'(store) - COUNT_BITS'(offer);
      if (offer) in_packet <= in_packet == LAST_WORD ? '0 : in_packet + 1'b1;
      if (free) begin
        m_tvalid <= offer;
        m_tlast  <= offer && in_packet == LAST_WORD;
      end
      if (ena) thresh_seen <= thresh_in;
      if (arrives && !fits) bridge_overflow <= bridge_overflow + 1'b1;
    end
endmodule
