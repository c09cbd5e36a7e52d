// Two histograms of 256 levels: `bank` counts, the other one is read. A counter is addressed, read,
// raised and written in a clock each; a level that comes again before that takes the count from where
// it is.
//
// Memory cannot be cleared at once: a bit of each level, and a register for each sixteen of them, say
// which counters hold something of this frame.
module level_counters #(
    parameter int N = 19,
    parameter int SEVERAL = 0  // 1: `counted` of several are added up
) (
    input  logic         clk,
    input  logic         clear,    // both
    input  logic         ended,    // the other one counts from the next clock on, from 0
    input  logic         bank,
    input  logic         into,     // the histogram for a level of this clock: `bank` behind the clock
    input  logic         counts,
    input  logic [  7:0] level,
    input  logic [  7:0] searched,
    output logic [N-1:0] counted   // of the level that was searched two clocks ago
);
  logic reads, reads_bank, raises, raises_bank, writes, writes_bank;
  logic [7:0] raised, written;
  logic [15:0] place;
  logic [7:0] reads_level;
  always_ff @(posedge clk) begin
    reads       <= counts && !clear;
    reads_bank  <= into;
    place       <= into ? {level, searched} : {searched, level};
    raises      <= reads && !clear;
    raises_bank <= reads_bank;
    raised      <= reads_level;
    writes      <= raises && !clear;
    writes_bank <= raises_bank;
    written     <= raised;
  end

  // Where several count at once, banks have many loads: a register more tells the level.
  if (SEVERAL != 0) begin : g_level
    always_ff @(posedge clk) reads_level <= level;
  end else begin : g_place
    assign reads_level = reads_bank ? place[15:8] : place[7:0];
  end

  // What a memory gives is inverted, or Yosys takes the register into its port.
  logic [2*N-1:0] not_values, count;
  logic [1:0] used;
  logic [N-1:0] higher, highest;
  for (genvar b = 0; b < 2; b++) begin : g_bank
    logic [N-1:0] histogram[0:255];
    logic [15:0] marks[0:15];
    logic [15:0] groups;
    wire [7:0] here = place[8*b+:8];
    wire group = groups[here[7:4]];
    wire [15:0] bits = marks[here[7:4]];
    logic marked;
    always_ff @(posedge clk) begin
      marked <= counts && !clear && into == 1'(b);
      if (writes && writes_bank == 1'(b)) histogram[written] <= higher;
      if (marked) marks[here[7:4]] <= (group ? bits : 16'd0) | (16'd1 << here[3:0]);
      if (clear || (ended && bank != 1'(b))) groups <= '0;
      else if (marked) groups[here[7:4]] <= 1'b1;
      not_values[b*N+:N] <= ~histogram[here];
      used[b] <= group && bits[here[3:0]];
    end
    assign count[b*N+:N] = used[b] ? ~not_values[b*N+:N] : '0;
  end
  if (SEVERAL != 0) begin : g_either
    logic [1:0] used_search;
    for (genvar b = 0; b < 2; b++) begin : g_used
      always_ff @(posedge clk)
        used_search[b] <= bank != 1'(b) && g_bank[b].group && g_bank[b].bits[place[8*b+:4]];
    end
    assign counted = (used_search[0] ? ~not_values[0+:N] : '0) | (used_search[1] ? ~not_values[N+:N] : '0);
  end else begin : g_other
    assign counted = bank ? count[0+:N] : count[N+:N];
  end

  logic written_just_now;
  wire again = writes && written == raised && writes_bank == raises_bank;
  wire [N-1:0] lower = again ? higher : written_just_now ? highest : raises_bank ? count[N+:N] : count[0+:N];
  always_ff @(posedge clk) begin
    higher           <= lower + 1'b1;
    highest          <= higher;
    written_just_now <= writes && written == reads_level && writes_bank == reads_bank;
  end
endmodule
