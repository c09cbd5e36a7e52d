// The labels that no blob has, oldest first; the next one is read ahead. Labels that were never used
// come before those that were given back: they need no memory. Registers, and no comparisons, tell
// whether there is a label: blob labelling runs at 100 MHz.
module free_labels #(
    parameter int LABELS = 128,
    parameter int BITS = $clog2(LABELS)
) (
    input  logic            clk,
    input  logic            rst,
    input  logic            take,       // `next` is used
    input  logic            give_back,
    input  logic [BITS-1:0] returned,
    output logic [BITS-1:0] next,
    output logic            found       // `next` is a label; it is 0 otherwise
);
  localparam logic [BITS-1:0] LAST = BITS'(LABELS - 1);

  logic [BITS-1:0] fifo[0:LABELS-1];
  logic [BITS-1:0] read, write;
  logic [BITS:0] count;      // labels in the FIFO
  logic waits;               // there is one
  logic [BITS-1:0] unused;   // the first label that was never used,
  logic fresh;               // if there is one
  wire fetch = (take || !found) && (fresh || waits);
  wire from_fifo = fetch && !fresh;

  always_ff @(posedge clk) if (give_back) fifo[write] <= returned;

  always_ff @(posedge clk)
    if (rst) begin
      read   <= '0;
      write  <= '0;
      count  <= '0;
      waits  <= 1'b0;
      unused <= BITS'(2);  // 0 is the background, 1 waits in `next`
      fresh  <= 1'b1;
      next   <= BITS'(1);
      found  <= 1'b1;
    end else begin
      if (give_back) write <= write == LAST ? '0 : write + 1'b1;
      if (from_fifo) read <= read == LAST ? '0 : read + 1'b1;
      count <= count + (BITS + 1)'(give_back) - (BITS + 1)'(from_fifo);
      waits <= give_back || (waits && !(from_fifo && count == (BITS + 1)'(1)));
      if (fetch && fresh) begin
        unused <= unused + 1'b1;
        fresh  <= unused != LAST;
      end
      if (fetch) next <= fresh ? unused : fifo[read];
      else if (take) next <= '0;
      if (fetch) found <= 1'b1;
      else if (take) found <= 1'b0;
    end
endmodule
