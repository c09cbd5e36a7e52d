// The sums of the windows in whose middle a clock's P neighbours are, from the sums of columns.
//
// From one window to the next one column enters and one leaves: a difference for each pixel. The window
// of pixel j is the last one of the clock before and the differences 0 to j. Only one addition follows
// from clock to clock.
//
// Windows end RADIUS px to the right of their middle. The clock's first pixel lies a whole number of
// clocks ahead of the middle: BESIDE px further.
module window_sums #(
    parameter int P = 2,       // pixels a clock, 2 or 4
    parameter int RADIUS = 5,
    parameter int C = 9,       // bits of a column's number, in clocks
    parameter int COLUMN = 12,
    parameter int SUM = 15
) (
    input  logic                clk,
    input  logic                clear,
    input  logic                push,
    input  logic [       C-1:0] column,       // of this clock, and of the next one that pushes
    input  logic [       C-1:0] next_column,
    input  logic [P*COLUMN-1:0] column_now,   // of the columns that pixels enter, with them
    input  logic [P*COLUMN-1:0] column_sum,   // a clock later
    output logic [   P*SUM-1:0] sums          // three clocks behind column_now
);
  localparam int WINDOW = 2 * RADIUS + 1;
  localparam int AHEAD = (RADIUS + P - 1) / P;
  localparam int BESIDE = P * AHEAD - RADIUS;

  // The newest column is on top.
  localparam int CLOCKS = (WINDOW + BESIDE + P - 1) / P - 2;  // behind column_sum
  localparam int GROUPS = CLOCKS > 1 ? CLOCKS : 1;
  localparam int PASSING = GROUPS * P * COLUMN;
  localparam int TOP = PASSING + P * COLUMN;  // where the columns of this clock are
  logic [PASSING-1:0] passing;
  // verilator lint_off UNUSEDSIGNAL
  // Windows need not end where clocks do.
  wire [TOP+P*COLUMN-1:0] newest = {column_now, column_sum, passing};
  // verilator lint_on UNUSEDSIGNAL
  always_ff @(posedge clk) passing <= newest[TOP-1-:PASSING];

  // Where in the row this clock is: the window of the row before still loses columns, and takes those
  // that came before the row began.
  logic at_start, waits;
  always_ff @(posedge clk)
    if (clear) {at_start, waits} <= 2'b11;
    else if (push) {at_start, waits} <= {next_column == '0, next_column < C'(AHEAD)};

  localparam int D = COLUMN + 1;  // signed
  logic [P*D-1:0] differences;
  for (genvar lane = 0; lane < P; lane++) begin : g_difference
    localparam int ENTERS = TOP + (lane - BESIDE) * COLUMN;
    localparam int LEAVES = TOP + (lane - BESIDE - WINDOW + P) * COLUMN;  // a clock ahead
    localparam int LOSES = (2 * RADIUS + BESIDE - lane) / P + 1;  // from this column on
    logic [COLUMN-1:0] leaves;
    wire enters = !waits || (at_start && lane < BESIDE);
    always_ff @(posedge clk) begin
      leaves <= next_column < C'(AHEAD) || next_column >= C'(LOSES) ? newest[LEAVES+:COLUMN] : '0;
      differences[lane*D+:D] <= (enters ? D'(newest[ENTERS+:COLUMN]) : '0) - D'(leaves);
    end
  end

  // The columns of the row's first window but the last one.
  logic [SUM-1:0] first_columns, group, group_now;
  logic ends, at_start_1, at_start_2, waits_1, waits_2, fits_1, fits_2;
  always_comb begin
    group_now = '0;
    for (int i = 0; i < P; i++)
      if (i < P - BESIDE || !ends) group_now = group_now + SUM'(column_sum[i*COLUMN+:COLUMN]);
  end
  always_ff @(posedge clk) begin
    ends <= column == C'(AHEAD - 1);
    {at_start_2, at_start_1} <= {at_start_1, at_start};
    {waits_2, waits_1} <= {waits_1, waits};
    {fits_2, fits_1} <= {fits_1, column == C'(AHEAD)};
    group <= group_now;
    if (waits_2) first_columns <= (at_start_2 ? '0 : first_columns) + group;
  end

  wire [SUM-1:0] base = fits_2 ? first_columns : sums[(P-1)*SUM+:SUM];
  for (genvar lane = 0; lane < P; lane++) begin : g_sum
    logic [SUM-1:0] change, change_now;
    always_comb begin
      change_now = '0;
      for (int i = 0; i <= lane; i++)
        change_now = change_now + {{SUM - D{differences[i*D+D-1]}}, differences[i*D+:D]};
    end
    always_ff @(posedge clk) begin
      change <= change_now;
      sums[lane*SUM+:SUM] <= base + change;
    end
  end
endmodule
