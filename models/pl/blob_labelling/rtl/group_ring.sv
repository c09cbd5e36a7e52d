// Runs of the row above that are still to come, and runs of this row, as in run_ring.sv; but a run may
// join two components, end, and touch a run above for the first time, all in one clock. So `right` is
// written at three places at once, `left` at two: each is the difference of as many memories.
//
// What is taken from the row above was finished two clocks before or more.
module group_ring #(
    parameter int RUNS = 324,  // even
    parameter int PLACE = $clog2(RUNS),
    parameter int BITS = 9
) (
    input  logic             clk,
    input  logic             rst,
    // A run of this row ends. If it is linked, its component's last one is to its left.
    input  logic             finishes,
    input  logic [ BITS-1:0] label,
    input  logic             valid,         // it has one
    input  logic             linked,
    // Which one that is: the run before, or the last one of `outer`; otherwise of `inner`.
    input  logic             behind_last,
    input  logic             behind_outer,
    // The runs of the component `inner` in this row become part of `outer`.
    input  logic             joins_linked,
    input  logic [ BITS-1:0] outer,
    input  logic [ BITS-1:0] inner,
    // The next run of the row above is taken.
    input  logic             take,
    output logic [ BITS-1:0] stored_label,
    output logic             stored_valid,
    output logic             stored_left,
    output logic             stored_right
);
  // Of a label's runs in this row. In LUT both would be too many loads for their address, the label.
  (* ram_style = "block" *) logic [PLACE-1:0] firsts[0:(1<<BITS)-1];
  (* ram_style = "distributed" *) logic [PLACE-1:0] lasts[0:(1<<BITS)-1];

  // What is to be written in the next clock: the run that ended, its neighbour to the left; and that
  // `inner` became part of `outer`: where `outer` ended, and where `inner` begins.
  logic [PLACE-1:0] write, last_write;
  logic adds, adds_valid, adds_linked, sets, moves, moves_last;
  logic [BITS-1:0] added_label, moved_label;
  logic [PLACE-1:0] not_set, not_joint, not_left, not_last;  // inverted, or Yosys takes them into the memory's ports
  wire [PLACE-1:0] set_place = ~not_set;
  wire [PLACE-1:0] joint_place = ~not_joint;
  wire [PLACE-1:0] left_place = ~not_left;
  wire [PLACE-1:0] last_place = ~not_last;

  // The last run of a label may be written just now, and its first one.
  wire [PLACE-1:0] last_mine = moves_last && moved_label == inner ? last_place : lasts[inner];
  wire [PLACE-1:0] last_others = moves_last && moved_label == outer ? last_place : lasts[outer];
  always_ff @(posedge clk) begin
    adds        <= finishes && !rst;
    adds_valid  <= valid;
    adds_linked <= linked;
    sets        <= finishes && linked && !rst;
    moves       <= joins_linked && !rst;
    moves_last  <= (finishes || joins_linked) && !rst;
    added_label <= label;
    moved_label <= finishes ? label : outer;
    not_set     <= ~(behind_last ? last_write : behind_outer ? last_others : last_mine);
    not_joint   <= ~last_others;
    not_left    <= ~(adds && !adds_linked && added_label == inner ? last_write : firsts[inner]);
    not_last    <= ~(finishes ? write : last_mine);
    if (finishes) last_write <= write;
    if (rst) write <= '0;
    else if (finishes) write <= write == PLACE'(RUNS - 1) ? '0 : write + 1'b1;
  end

  always_ff @(posedge clk) begin
    if (adds && !adds_linked) firsts[added_label] <= last_write;
    if (moves_last) lasts[moved_label] <= last_place;
  end

  logic next_is_odd;
  localparam int RUN = BITS + 3;  // right, left, valid, label
  logic [2*RUN-1:0] found;
  for (genvar odd = 0; odd < 2; odd++) begin : g_half
    logic [BITS:0] labels[0:RUNS/2-1];
    logic left_new[0:RUNS/2-1];
    logic left_set[0:RUNS/2-1];
    logic right_new[0:RUNS/2-1];
    logic right_set[0:RUNS/2-1];
    logic right_joint[0:RUNS/2-1];
    wire adds_here = adds && last_write[0] == 1'(odd);
    wire sets_here = sets && set_place[0] == 1'(odd);
    wire joins_here = moves && joint_place[0] == 1'(odd);
    wire moves_here = moves && left_place[0] == 1'(odd);
    wire [PLACE-2:0] added = last_write[PLACE-1:1];
    wire [PLACE-2:0] set = set_place[PLACE-1:1];
    wire [PLACE-2:0] joint = joint_place[PLACE-1:1];
    wire [PLACE-2:0] moved = left_place[PLACE-1:1];
    logic [PLACE-2:0] place;
    always_ff @(posedge clk) begin
      if (adds_here) begin
        labels[added]    <= {adds_valid, added_label};
        left_new[added]  <= left_set[added] ^ adds_linked;
        right_new[added] <= right_set[added] ^ right_joint[added];
      end
      if (moves_here) left_set[moved] <= !left_new[moved];
      if (sets_here) right_set[set] <= !(right_new[set] ^ right_joint[set]);
      if (joins_here) right_joint[joint] <= !(right_new[joint] ^ right_set[joint]);
      if (rst) place <= '0;
      else if (take && next_is_odd == 1'(odd))
        place <= place == (PLACE - 1)'(RUNS / 2 - 1) ? '0 : place + 1'b1;
    end
    wire right = (right_new[place] ^ right_set[place] ^ right_joint[place])
               || (sets_here && set == place) || (joins_here && joint == place);
    wire left = (left_new[place] ^ left_set[place]) || (moves_here && moved == place);
    assign found[odd*RUN+:RUN] = {right, left, labels[place]};
  end
  wire [RUN-1:0] next = take == next_is_odd ? found[0+:RUN] : found[RUN+:RUN];

  // The next run is read again in every clock, and one ahead when it is taken. How many there are
  // tells which one is not in the memory yet.
  logic [PLACE-1:0] count;
  logic none, one, two;  // runs to come
  logic arrives;         // the one that ended is the next one
  always_ff @(posedge clk) begin
    arrives <= finishes && (take ? one : none);
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
    {stored_right, stored_left, stored_valid, stored_label} <=
        arrives ? {1'b0, adds_linked, adds_valid, added_label} : next;
  end
endmodule
