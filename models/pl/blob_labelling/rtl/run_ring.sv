// Runs of the row above that are still to come, and runs of this row: label, and whether their
// component has another run to the left and to the right. Written one clock behind the decision.
//
// Even and odd places lie in memories of their own, so the next run and the one behind it are read at
// once. `right` is written at two places at once: 0 for the new run, 1 for the one that it continues.
// It is the difference of two memories, so that each has one port for writing.
module run_ring #(
    parameter int RUNS = 324,  // even
    parameter int PLACE = $clog2(RUNS),
    parameter int BITS = 9
) (
    input  logic             clk,
    input  logic             rst,
    input  logic             begins_row,    // the next run to end is the row's first
    // A run of this row ends. If it is linked, its component's last one is to its left.
    input  logic             finishes,
    input  logic [ BITS-1:0] label,
    input  logic             valid,         // it has one
    input  logic             linked,
    // The runs of the component `inner` in this row become part of `outer`; it may happen only where
    // components meet, and no run ends there.
    input  logic             meets,
    input  logic             joins_linked,
    input  logic [ BITS-1:0] outer,
    input  logic [ BITS-1:0] inner,
    input  logic [ BITS-1:0] not_inner,     // the same, inverted
    input  logic [ BITS-1:0] next_inner,    // in the next clock
    // The next run of the row above is taken, and known from the clock on behind the one in which it
    // ended.
    input  logic             take,
    output logic [ BITS-1:0] stored_label,
    output logic             stored_valid,
    output logic             stored_left,
    output logic             stored_right,  // before what is written in this clock
    output logic             first_is_set   // in this clock `right` of the row's first run is written
);
  // Of a label's runs in this row. In LUT both would be too many loads for their address, the label.
  logic [PLACE-1:0] first[0:(1<<BITS)-1];
  (* ram_style = "distributed" *) logic [PLACE-1:0] last[0:(1<<BITS)-1];

  // What is to be written in the next clock: the run that ended, or that `inner` became part of `outer`.
  logic [PLACE-1:0] write;
  logic adds, adds_valid, adds_linked, sets, moves, moves_last;
  logic [PLACE-1:0] left_place;
  logic [PLACE-1:0] not_mine, not_set;  // inverted, or Yosys takes them into the memory's ports
  logic [BITS-1:0] first_label, last_label, not_last_label;
  wire [PLACE-1:0] set_place = ~not_set;
  wire [PLACE-1:0] last_place = moves ? ~not_mine : left_place;

  // The last run of a label may be written just now. Inverted, for comparisons: the memory's address has
  // loads enough.
  wire last_is_mine, last_is_others;
  same_bits #(
      .BITS(BITS)
  ) with_inner (
      .a(~not_last_label),
      .b(inner),
      .same(last_is_mine)
  );
  same_bits #(
      .BITS(BITS)
  ) with_outer (
      .a(~not_last_label),
      .b(outer),
      .same(last_is_others)
  );
  wire writes_mine = moves_last && last_is_mine;
  wire writes_others = moves_last && last_is_others;
  wire [PLACE-1:0] last_mine = writes_mine ? last_place : last[~not_inner];
  wire from_place = meets ? writes_others : writes_mine;
  wire from_mine = !meets && !writes_mine;
  wire from_others = meets && !writes_others;
  // The first run, too, or in the clock before, in which the memory was read.
  wire writes_first = adds && !adds_linked;
  logic wrote_first;
  logic [BITS-1:0] wrote_label;
  logic [PLACE-1:0] wrote_place, first_read;
  wire [PLACE-1:0] first_mine = writes_first && first_label == inner ? left_place
                              : wrote_first && wrote_label == inner ? wrote_place : first_read;

  always_ff @(posedge clk) begin
    adds        <= finishes && !rst;
    adds_valid  <= valid;
    adds_linked <= linked;
    moves       <= joins_linked && !rst;
    moves_last  <= (finishes || joins_linked) && !rst;
    sets        <= ((finishes && linked) || joins_linked) && !rst;
    not_mine    <= ~last_mine;
    // Of `meets`, for `joins_linked` comes late.
    not_set     <= ~((from_place ? last_place : '0) | (from_mine ? last[~not_inner] : '0)
                     | (from_others ? last[outer] : '0));
    left_place  <= meets ? first_mine : write;
    first_label <= label;
    last_label  <= meets ? outer : label;
    not_last_label <= ~(meets ? outer : label);
    if (rst) write <= '0;
    else if (finishes) write <= write == PLACE'(RUNS - 1) ? '0 : write + 1'b1;
  end

  // The label of the row's first run, which is `alone` until another run gets it.
  logic [BITS-1:0] opener;
  logic opens_row, alone;
  wire joins_first = alone && ((finishes && linked && label == opener) || (joins_linked && outer == opener));
  always_ff @(posedge clk) begin
    if (finishes && opens_row) opener <= label;
    alone <= finishes && opens_row ? valid : alone && !joins_first;
    opens_row <= rst || begins_row || (opens_row && !finishes);
    first_is_set <= joins_first && !rst;
  end

  always_ff @(posedge clk) begin
    if (writes_first) first[first_label] <= left_place;
    first_read <= first[next_inner];
    {wrote_first, wrote_label, wrote_place} <= {writes_first, first_label, left_place};
    if (moves_last) last[last_label] <= last_place;
  end

  logic next_is_odd;
  localparam int RUN = BITS + 3;  // right, left, valid, label
  logic [2*RUN-1:0] found;
  for (genvar odd = 0; odd < 2; odd++) begin : g_half
    logic [BITS:0] labels[0:RUNS/2-1];
    logic lefts[0:RUNS/2-1];
    logic right_new[0:RUNS/2-1];
    logic right_set[0:RUNS/2-1];
    wire adds_here = left_place[0] == 1'(odd);
    wire sets_here = sets && set_place[0] == 1'(odd);
    wire [PLACE-2:0] added = left_place[PLACE-1:1];
    wire [PLACE-2:0] set = set_place[PLACE-1:1];
    logic [PLACE-2:0] place, not_place;  // the same: each is an address with half of the loads
    wire [PLACE-2:0] next_place = place == (PLACE - 1)'(RUNS / 2 - 1) ? '0 : place + 1'b1;
    always_ff @(posedge clk) begin
      if (adds && adds_here) labels[added] <= {adds_valid, first_label};
      if ((adds || moves) && adds_here) lefts[added] <= moves || adds_linked;
      if (adds && adds_here) right_new[added] <= right_set[added];
      if (sets_here) right_set[set] <= !right_new[set];
      if (rst) {place, not_place} <= {(PLACE - 1)'(0), ~(PLACE - 1)'(0)};
      else if (take && next_is_odd == 1'(odd)) {place, not_place} <= {next_place, ~next_place};
    end
    wire right = (right_new[~not_place] ^ right_set[~not_place]) || (sets_here && set == ~not_place);
    assign found[odd*RUN+:RUN] = {right, lefts[place], labels[place]};
  end
  wire [RUN-1:0] next = take == next_is_odd ? found[0+:RUN] : found[RUN+:RUN];

  // The next run is read again in every clock, and one ahead when it is taken. How many there are
  // tells which one is not in the memory yet.
  logic [PLACE-1:0] count;
  logic none, one, two;  // runs to come
  wire arrives = finishes && (take ? one : none);  // the run that ends is the next one,
  logic arrived, followed;  // or was, or the one behind that
  wire rewrites = take ? followed : arrived;
  always_ff @(posedge clk) begin
    arrived  <= arrives;
    followed <= finishes && (take ? two : one);
    if (rst) begin
      next_is_odd <= 1'b0;
      count       <= '0;
      none        <= 1'b1;
      one         <= 1'b0;
      two         <= 1'b0;
    end else begin
      if (take) next_is_odd <= !next_is_odd;
      if (finishes && !take) begin
        count <= count + 1'b1;
        none  <= 1'b0;
        one   <= none;
        two   <= one;
      end else if (take && !finishes) begin
        count <= count - 1'b1;
        none  <= one;
        one   <= two;
        two   <= count == PLACE'(3);
      end
    end
    if (arrives) {stored_right, stored_left, stored_valid, stored_label} <= {1'b0, linked, valid, label};
    else if (rewrites)
      {stored_right, stored_left, stored_valid, stored_label} <= {1'b0, adds_linked, adds_valid, first_label};
    else {stored_right, stored_left, stored_valid, stored_label} <= next;
  end
endmodule
