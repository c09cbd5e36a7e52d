// Runs of the row above that are still to come, and runs of this row: label, and whether their
// component has another run to the left and to the right. Written one clock behind the decision.
//
// `right` is written at two places at once: 0 for the new run, 1 for the one that it continues. It is
// the difference of two memories, so that each has one port for writing.
module run_ring #(
    parameter int PLACE = 9,
    parameter int BITS = 9
) (
    input  logic             clk,
    input  logic             rst,
    // A run of this row ends. If it is linked, its component's last one is to its left.
    input  logic             finishes,
    input  logic [ BITS-1:0] label,
    input  logic             valid,       // it has one
    input  logic             linked,
    // The runs of the component `inner` in this row become part of `outer`.
    input  logic             joins_linked,
    input  logic [ BITS-1:0] outer,
    input  logic [ BITS-1:0] inner,
    // The next run of the row above is taken.
    input  logic             take,
    input  logic [PLACE-1:0] held_place,
    input  logic             held_right,
    output logic [PLACE-1:0] read,
    output logic [ BITS-1:0] next_label,
    output logic             next_valid,
    output logic             joins_valid, // of the next run in a clock in which no run ends
    output logic             joins_left,
    output logic             joins_same,  // its label is `inner`
    output logic             next_left,
    output logic             next_right,  // with what is written in this clock
    output logic             right        // of the run that was taken last, the same
);
  logic [PLACE-1:0] first[0:(1<<BITS)-1];  // of a label's runs in this row
  logic [PLACE-1:0] last[0:(1<<BITS)-1];
  logic [BITS:0] labels[0:(1<<PLACE)-1];  // and whether it has one
  logic lefts[0:(1<<PLACE)-1];
  logic right_new[0:(1<<PLACE)-1];
  logic right_set[0:(1<<PLACE)-1];

  // What is to be written in the next clock.
  logic [PLACE-1:0] write;
  logic adds, adds_valid, adds_linked, sets, moves, moves_last;
  logic [PLACE-1:0] set_place, left_place, last_value;
  logic [BITS-1:0] first_label, last_label;

  // The last run of a label may be written just now.
  wire [PLACE-1:0] last_mine = moves_last && last_label == inner ? last_value : last[inner];
  wire [PLACE-1:0] last_outer = moves_last && last_label == outer ? last_value : last[outer];
  wire [PLACE-1:0] first_mine = adds && !adds_linked && first_label == inner ? left_place : first[inner];

  always_ff @(posedge clk) begin
    adds        <= finishes && !rst;
    adds_valid  <= valid;
    adds_linked <= linked;
    moves       <= joins_linked && !rst;
    moves_last  <= (finishes || joins_linked) && !rst;
    sets        <= ((finishes && linked) || joins_linked) && !rst;
    set_place   <= joins_linked ? last_outer : last_mine;
    left_place  <= joins_linked ? first_mine : write;
    first_label <= label;
    last_label  <= joins_linked ? outer : label;
    last_value  <= joins_linked ? last_mine : write;
    if (rst) write <= '0;
    else if (finishes) write <= write + 1'b1;
  end

  always_ff @(posedge clk) begin
    if (adds) labels[left_place] <= {adds_valid, first_label};
    if (adds && !adds_linked) first[first_label] <= left_place;
    if (moves_last) last[last_label] <= last_value;
    if (adds || moves) lefts[left_place] <= moves || adds_linked;
    if (adds) right_new[left_place] <= right_set[left_place];
    if (sets) right_set[set_place] <= !right_new[set_place];
  end

  // The next run is read again in every clock, and one ahead when it is taken. One that spans the row
  // is taken when it ends (`now`), or before it can be read (`fresh`).
  logic [PLACE-1:0] following;
  wire [PLACE-1:0] place = take ? following : read;
  logic [BITS-1:0] stored_label;
  logic empty, fresh, fresh_following, stored_valid, stored_left, stored_right;
  // At both places, so that `take` selects bits and no addresses.
  wire right_read = (right_new[read] ^ right_set[read]) || (sets && set_place == read);
  wire right_following = (right_new[following] ^ right_set[following]) || (sets && set_place == following);
  wire now = finishes && empty;
  wire rewrites = take ? fresh_following : fresh;  // what is read is being written
  always_ff @(posedge clk) begin
    if (rst) begin
      read      <= '0;
      following <= PLACE'(1);
      empty     <= 1'b1;
      fresh <= 1'b0;
      fresh_following <= 1'b0;
    end else begin
      read <= place;
      if (take) following <= following + 1'b1;
      empty <= (finishes ? write + 1'b1 : write) == place;
      fresh <= finishes && write == place;
      fresh_following <= finishes && write == (take ? following + 1'b1 : following);
    end
    {stored_valid, stored_label} <= rewrites ? {adds_valid, first_label} : labels[place];
    stored_left  <= rewrites ? adds_linked : take ? lefts[following] : lefts[read];
    stored_right <= !rewrites && (take ? right_following : right_read);
  end
  assign next_label = now ? label : fresh ? first_label : stored_label;
  assign next_valid = now ? valid : joins_valid;
  assign joins_valid = fresh ? adds_valid : stored_valid;
  assign joins_left = fresh ? adds_linked : stored_left;
  assign joins_same = fresh ? first_label == inner : stored_label == inner;
  assign next_left = now ? linked : joins_left;
  assign next_right = !now && !fresh && (stored_right || (sets && set_place == read));
  assign right = held_right || (sets && set_place == held_place);
endmodule
