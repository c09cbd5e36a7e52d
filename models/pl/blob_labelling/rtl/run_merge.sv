// Takes the runs of a row and those of the row above from left to right, one per clock. Which of the
// two ends first, and whether they touch, was compared one clock earlier. Results appear one clock
// later.
module run_merge #(
    parameter int RUNS = 324,   // places in the ring of runs
    parameter int PLACE = $clog2(RUNS),
    parameter int COLUMN = 10,
    parameter int Y_BITS = 9
) (
    input  logic              clk,
    input  logic              rst,
    // run_fifo.sv: what is in front, and what will be.
    input  logic              waits,
    input  logic              is_end,
    input  logic              is_frame_end,
    input  logic [COLUMN-1:0] first,
    input  logic [COLUMN-1:0] behind,
    input  logic              next_waits,
    input  logic              next_is_end,
    input  logic [COLUMN-1:0] next_first,
    input  logic [COLUMN-1:0] next_behind,
    output logic              take,
    // The run above is looked at for the first time; it touches the present one; it passes.
    output logic              takes_above,
    output logic              touches,
    output logic              passes,
    output logic              finishes,      // the present run ends:
    output logic [COLUMN-1:0] run_first,
    output logic [COLUMN-1:0] run_behind,
    output logic [COLUMN-1:0] run_length,
    output logic [Y_BITS-1:0] run_row,
    output logic              frame_is_over
);
  localparam logic [PLACE-1:0] LAST = PLACE'(RUNS - 1);

  // Of the runs in front and above.
  logic pass, touch, finish, end_row;
  logic has_above, fresh, below;  // `below`: the row behind the frame, which has no runs
  logic [Y_BITS-1:0] row;
  wire stays = is_frame_end && !below;  // the end of the frame is that of two rows
  assign take = finish || (end_row && !stays);

  // Runs that were finished: what is left of the row above, and the present row. The first three are at
  // hand; the memory gives the third one.
  logic [PLACE-1:0] write, row_start, second, third, fourth;  // places
  logic none, one, two;  // runs in the ring
  logic [PLACE-1:0] count;
  logic [COLUMN-1:0] above_first, above_behind, second_first, second_behind;
  logic pushed_third;
  (* ram_style = "block" *) logic [COLUMN-1:0] firsts[0:RUNS-1];
  (* ram_style = "block" *) logic [COLUMN-1:0] behinds[0:RUNS-1];
  logic [COLUMN-1:0] stored_first, stored_behind;
  wire [COLUMN-1:0] third_first = pushed_third ? run_first : stored_first;
  wire [COLUMN-1:0] third_behind = pushed_third ? run_behind : stored_behind;
  wire [PLACE-1:0] place = pass ? fourth : third;
  always_ff @(posedge clk) begin
    if (finish) begin
      firsts[write]  <= first;
      behinds[write] <= behind;
    end
    stored_first  <= firsts[place];
    stored_behind <= behinds[place];
    pushed_third  <= finish && two;
    if (pass) {above_first, above_behind} <= {second_first, second_behind};
    else if (none) {above_first, above_behind} <= {first, behind};
    if (pass) {second_first, second_behind} <= {third_first, third_behind};
    else if (one) {second_first, second_behind} <= {first, behind};
    if (rst) begin
      write     <= '0;
      row_start <= '0;
      second    <= PLACE'(1);
      third     <= PLACE'(2);
      fourth    <= PLACE'(3);
      count     <= '0;
      {two, one, none} <= 3'b001;
    end else begin
      if (end_row) row_start <= write;
      if (finish) begin
        write <= write == LAST ? '0 : write + 1'b1;
        count <= count + 1'b1;
        {two, one, none} <= {one, none, 1'b0};
      end else if (pass) begin
        {second, third} <= {third, fourth};
        fourth <= fourth == LAST ? '0 : fourth + 1'b1;
        count <= count - 1'b1;
        {two, one, none} <= {count == PLACE'(3), two, one};
      end
    end
  end

  // What happens in the next clock: another run above, or another one in front.
  wire more_above = second != row_start;
  wire here = write != row_start;  // the row has runs
  wire next_above = end_row ? here : has_above;
  wire passes_second = second_behind <= behind;
  wire touches_second = second_first <= behind && first <= second_behind;
  wire passes_next = above_behind <= next_behind;
  wire touches_next = above_first <= next_behind && next_first <= above_behind;
  wire moves = take || !waits;
  always_ff @(posedge clk)
    if (rst) begin
      {pass, touch, finish, end_row} <= 4'd0;
      has_above <= 1'b0;
    end else if (pass) begin
      pass      <= more_above && (is_end || passes_second);
      touch     <= more_above && !is_end && touches_second;
      finish    <= !is_end && !(more_above && passes_second);
      end_row   <= is_end && !more_above;
      has_above <= more_above;
    end else if (moves) begin
      pass      <= next_waits && next_above && (next_is_end || passes_next);
      touch     <= next_waits && next_above && !next_is_end && touches_next;
      finish    <= next_waits && !next_is_end && !(next_above && passes_next);
      end_row   <= next_waits && next_is_end && !next_above;
      has_above <= next_above;
    end else begin
      // The end of the frame's last row: the runs of that pass behind it.
      pass      <= here;
      touch     <= 1'b0;
      finish    <= 1'b0;
      end_row   <= !here;
      has_above <= here;
    end

  always_ff @(posedge clk) begin
    run_first  <= first;
    run_behind <= behind;
    run_length <= behind - first;
    run_row    <= row;
    if (rst) begin
      {takes_above, touches, passes, finishes, frame_is_over} <= 5'd0;
      fresh <= 1'b1;
      below <= 1'b0;
      row   <= '0;
    end else begin
      takes_above   <= fresh && (pass || (finish && has_above));
      touches       <= touch;
      passes        <= pass;
      finishes      <= finish;
      frame_is_over <= end_row && below;
      if (pass || end_row) fresh <= 1'b1;
      else if (finish && has_above) fresh <= 1'b0;
      if (end_row) begin
        below <= stays;
        row   <= is_frame_end ? '0 : row + 1'b1;
      end
    end
  end
endmodule
