// Runs of dark pixels that wait for their turn, and between them the ends of rows. Several come in a
// clock, one leaves. What is in front is a register, and so is what lies behind it: what comes in a
// clock may be in front in the next one.
//
// A run that finds no room is lost; ends of rows always have room.
module run_fifo #(
    parameter int DEPTH = 64,   // runs
    parameter int ENDS = 4,     // ends of rows that wait at most
    parameter int COLUMN = 10
) (
    input  logic                clk,
    input  logic                rst,
    // What comes: runs, then the end of a row.
    input  logic [         2:0] come,      // the lowest is the first
    input  logic [3*COLUMN-1:0] first,
    input  logic [3*COLUMN-1:0] behind,
    input  logic                row_ends,
    input  logic                frame_ends,
    input  logic                take,      // what is in front leaves, if anything is there
    // In front, if `waits`.
    output logic                waits,
    output logic                is_end,    // of a row
    output logic                is_frame_end,
    output logic [  COLUMN-1:0] front_first,
    output logic [  COLUMN-1:0] front_behind,
    // What is in front in the next clock, if something leaves or nothing waits now.
    output logic                next_waits,
    output logic                next_is_end,
    output logic [  COLUMN-1:0] next_first,
    output logic [  COLUMN-1:0] next_behind,
    // Pixels that were lost: of the first run that comes, and of the others, which are short; a clock later.
    output logic [  COLUMN-1:0] lost,
    output logic [         1:0] lost_more
);
  localparam int ITEM = 2 * COLUMN + 2;  // end of a frame, of a row, behind, first
  localparam int PLACES = 1 << $clog2((DEPTH + ENDS + 3) / 4);  // in each of four memories
  localparam int PLACE = $clog2(PLACES);
  localparam int COUNT = PLACE + 3;

  // Which runs have room, by what there was before this clock.
  logic [COUNT-1:0] runs, items;
  logic [2:0] room;  // for a run, for two, for three
  wire [2:0] kept = come & room;
  wire [1:0] kept_count = kept[2] ? 2'd3 : kept[1] ? 2'd2 : {1'b0, kept[0]};
  // Whether so many come, with the end of the row; without carry chains, which would be long for this.
  wire [4:1] at_least = {kept[2] && row_ends, kept[2] || (kept[1] && row_ends),
                         kept[1] || (kept[0] && row_ends), kept[0] || row_ends};
  wire none_comes = !at_least[1];
  wire one_comes = at_least[1] && !at_least[2];
  wire two_come = at_least[2] && !at_least[3];
  wire [2:0] count = {at_least[4], at_least[2] && !at_least[4], one_comes || (at_least[3] && !at_least[4])};
  wire takes_run = take && waits && !is_end;
  wire [COUNT-1:0] runs_come = runs + COUNT'(kept_count);
  always_ff @(posedge clk)
    if (rst) begin
      runs <= '0;
      room <= '1;
    end else begin
      runs <= runs_come - COUNT'(takes_run);
      for (int i = 0; i < 3; i++)
        room[i] <= takes_run ? runs_come <= COUNT'(DEPTH - i) : runs_come <= COUNT'(DEPTH - 1 - i);
    end

  wire [1:0] length_1 = 2'(behind[COLUMN+:2] - first[COLUMN+:2]);
  always_ff @(posedge clk) begin
    lost      <= !rst && come[0] && !room[0] ? behind[0+:COLUMN] - first[0+:COLUMN] : '0;
    lost_more <= rst ? '0 : (come[1] && !room[1] ? length_1 : 2'd0) + 2'(come[2] && !room[2]);
  end

  // In the order in which they come; behind the last run the end of the row, whose place says nothing.
  logic [4*ITEM-1:0] comes;
  always_comb
    for (int i = 0; i < 4; i++) begin
      comes[i*ITEM+:2*COLUMN] = i < 3 ? {behind[(i<3?i:0)*COLUMN+:COLUMN], first[(i<3?i:0)*COLUMN+:COLUMN]} : '0;
      comes[i*ITEM+2*COLUMN+:2] = {frame_ends, i >= 3 || !kept[i<3?i:0]};
    end
  wire [ITEM-1:0] comes_0 = comes[0+:ITEM];
  wire [ITEM-1:0] comes_1 = comes[ITEM+:ITEM];
  wire [ITEM-1:0] comes_2 = comes[2*ITEM+:ITEM];
  wire [ITEM-1:0] comes_3 = comes[3*ITEM+:ITEM];

  // Four memories in turn, so that all have a place at once. Each knows which one of those that come it
  // takes, and where it has room: one count for all would have too many loads. What it gives next is in a
  // register: it has four clocks' time to read.
  logic [1:0] turn;  // of the memory that has what lies three behind the front
  logic [4*ITEM-1:0] stored;
  wire takes = take && waits;
  for (genvar bank = 0; bank < 4; bank++) begin : g_bank
    logic [ITEM-1:0] memory[0:PLACES-1];
    logic [ITEM-1:0] next;
    logic [1:0] number;
    logic [PLACE-1:0] place, next_place;
    wire takes_one = number[1] ? (number[0] ? at_least[4] : at_least[3]) : (number[0] ? at_least[2] : at_least[1]);
    wire [ITEM-1:0] item = number[1] ? (number[0] ? comes_3 : comes_2) : (number[0] ? comes_1 : comes_0);
    always_ff @(posedge clk) begin
      if (takes_one) memory[place] <= item;
      next <= takes_one && place == next_place ? item : memory[next_place];
      if (rst) begin
        number     <= 2'(bank);
        place      <= '0;
        next_place <= PLACE'(bank < 3);
      end else begin
        number <= number - count[1:0];
        if (takes_one) place <= place + 1'b1;
        if (takes && turn == 2'(bank)) next_place <= next_place + 1'b1;
      end
    end
    assign stored[bank*ITEM+:ITEM] = next;
  end
  wire [ITEM-1:0] fourth = turn[1] ? (turn[0] ? stored[3*ITEM+:ITEM] : stored[2*ITEM+:ITEM])
                                   : (turn[0] ? stored[ITEM+:ITEM] : stored[0+:ITEM]);

  // The front and what lies behind it.
  logic one, two, three, more;  // that wait; `more` are three or more
  logic [ITEM-1:0] front, second, third;
  assign {is_frame_end, is_end, front_behind, front_first} = front;
  wire [ITEM-1:0] next = two || more ? second : comes_0;
  assign {next_is_end, next_behind, next_first} = next[ITEM-2:0];
  assign next_waits = two || more || at_least[1];
  always_ff @(posedge clk) begin
    if (takes || !waits) front <= next;
    if (takes) second <= more ? third : two ? comes_0 : comes_1;
    else if (!(two || more)) second <= one ? comes_0 : comes_1;
    if (takes) third <= one ? comes_2 : two ? comes_1 : three ? comes_0 : fourth;
    else if (!more) third <= two ? comes_0 : one ? comes_1 : comes_2;
    if (rst) begin
      turn  <= 2'd3;
      items <= '0;
      waits <= 1'b0;
      one   <= 1'b0;
      two   <= 1'b0;
      more  <= 1'b0;
    end else begin
      turn  <= turn + 2'(takes);
      items <= items + COUNT'(count) - COUNT'(takes);
      waits <= takes || !waits ? next_waits : 1'b1;
      one   <= !waits ? one_comes
             : one ? (takes ? one_comes : none_comes)
             : two && takes && none_comes;
      two   <= !waits ? two_come
             : one ? (takes ? two_come : one_comes)
             : two ? (takes ? one_comes : none_comes)
             : three && takes && none_comes;
      more  <= !waits ? at_least[3]
             : one ? (takes ? at_least[3] : at_least[2])
             : two ? (takes ? at_least[2] : at_least[1])
             : !(three && takes && none_comes);
    end
  end
  assign three = items == COUNT'(3);
endmodule
