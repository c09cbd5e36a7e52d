// The labels that no blob has, oldest first; the next one is read ahead. Labels that were never used
// come before those that were given back: they need no memory.
module free_labels #(
    parameter int LABELS = 128,
    parameter int BITS = $clog2(LABELS)
) (
    input  logic            clk,
    input  logic            rst,
    input  logic            take,       // `next` is used
    input  logic            give_back,
    input  logic [BITS-1:0] returned,
    output logic [BITS-1:0] next        // 0: none is free
);
  localparam logic [BITS-1:0] LAST = BITS'(LABELS - 1);

  logic [BITS-1:0] fifo[0:LABELS-1];
  logic [BITS-1:0] read, write;
  logic [BITS:0] count;      // labels in the FIFO
  logic [BITS:0] unused;     // the first label that was never used
  wire fresh = unused != (BITS + 1)'(LABELS);
  wire fetch = (take || next == '0) && (fresh || count != '0);
  wire from_fifo = fetch && !fresh;

  always_ff @(posedge clk) if (give_back) fifo[write] <= returned;

  always_ff @(posedge clk)
    if (rst) begin
      read   <= '0;
      write  <= '0;
      count  <= '0;
      unused <= (BITS + 1)'(2);  // 0 is the background, 1 waits in `next`
      next   <= BITS'(1);
    end else begin
      if (give_back) write <= write == LAST ? '0 : write + 1'b1;
      if (from_fifo) read <= read == LAST ? '0 : read + 1'b1;
      count <= count + (BITS + 1)'(give_back) - (BITS + 1)'(from_fifo);
      if (fetch && fresh) unused <= unused + 1'b1;
      if (fetch) next <= fresh ? unused[BITS-1:0] : fifo[read];
      else if (take) next <= '0;
    end
endmodule
