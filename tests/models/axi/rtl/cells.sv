// The vendor's cells beside what they should do, said in another way. A bit of `wrong` for each that ever differs; BREAK makes one differ.
module cells #(
    parameter BREAK = 0
) (
    input  logic        clk,
    output logic [15:0] wrong,
    output logic [15:0] compared
);
  logic [15:0] n = 0;
  logic [31:0] noise = 32'h1234_5678;
  always_ff @(posedge clk) begin
    n <= n + 1;
    noise <= {noise[30:0], noise[31] ^ noise[21] ^ noise[1] ^ noise[0]};
  end
  wire on = noise[3], start = noise[9] & noise[11];

  // Buffers, and a flip-flop on a buffered clock.
  wire buffered, p, m, back;
  BUFG clock_buffer (.O(buffered), .I(clk));
  OBUFDS #(.IOSTANDARD("TMDS_33")) out (.O(p), .OB(m), .I(noise[0]));
  IBUFDS #(.DIFF_TERM("FALSE")) in (.O(back), .I(p), .IB(m));

  // Flip-flops.
  wire fdre, fdse, fdce, fdpe;
  logic re = 1, se = 1, ce = 0, pe = 1;
  FDRE #(.INIT(1'b1)) fdre_i (.Q(fdre), .C(buffered), .CE(on), .D(noise[0] ^ (BREAK != 0)), .R(start));
  FDSE fdse_i (.Q(fdse), .C(clk), .CE(on), .D(noise[0]), .S(start));
  FDCE fdce_i (.Q(fdce), .C(clk), .CE(on), .D(noise[0]), .CLR(n < 8));
  FDPE fdpe_i (.Q(fdpe), .C(clk), .CE(on), .D(noise[0]), .PRE(n < 8));
  always_ff @(posedge clk) begin
    re <= start ? 0 : on ? noise[0] : re;
    se <= start ? 1 : on ? noise[0] : se;
    if (n >= 8) ce <= on ? noise[0] : ce;
    if (n >= 8) pe <= on ? noise[0] : pe;
  end

  // Tables, carry, shift registers.
  wire lut3, lut6, o5, o6, f7;
  wire [3:0] carries, sum;
  LUT3 #(.INIT(8'h96)) lut3_i (.O(lut3), .I0(noise[0]), .I1(noise[1]), .I2(noise[2]));
  LUT6 #(.INIT(64'h8000_0000_0000_0000)) lut6_i (
      .O(lut6), .I0(noise[0]), .I1(noise[1]), .I2(noise[2]), .I3(noise[3]), .I4(noise[4]), .I5(noise[5]));
  LUT6_2 #(.INIT(64'hFFFF_FFFE_8000_0000)) lut6_2_i (
      .O5(o5), .O6(o6), .I0(noise[0]), .I1(noise[1]), .I2(noise[2]), .I3(noise[3]), .I4(noise[4]), .I5(noise[5]));
  MUXF7 mux (.O(f7), .I0(noise[0]), .I1(noise[1]), .S(noise[2]));
  CARRY4 adder (.CO(carries), .O(sum), .CI(1'b0), .CYINIT(noise[8]), .DI(noise[3:0]), .S(noise[3:0] ^ noise[7:4]));
  wire srl16, srl32, end32;
  logic [31:0] last = 0;
  SRL16E srl16_i (.Q(srl16), .A0(n[0]), .A1(n[1]), .A2(n[2]), .A3(n[3]), .CE(on), .CLK(clk), .D(noise[0]));
  SRLC32E srl32_i (.Q(srl32), .Q31(end32), .A(n[4:0]), .CE(on), .CLK(clk), .D(noise[0]));
  always_ff @(posedge clk) if (on) last <= {last[30:0], noise[0]};

  // A gated clock counts the clocks with its enable.
  wire gated;
  logic [15:0] counted = 0, expected_count = 0;
  BUFGCE gate (.O(gated), .CE(on), .I(clk));
  always_ff @(posedge gated) counted <= counted + 1;
  always_ff @(posedge clk) if (on) expected_count <= expected_count + 1;

  // Crossings within one clock: a register and two stages, or four.
  wire one, arst;
  wire [3:0] several;
  logic [7:0] history = 0;
  logic [11:0] words = 0;
  xpm_cdc_single #(.DEST_SYNC_FF(2)) single (.src_clk(clk), .src_in(noise[0]), .dest_clk(clk), .dest_out(one));
  xpm_cdc_array_single #(.DEST_SYNC_FF(3), .SRC_INPUT_REG(0), .WIDTH(4)) array (
      .src_clk(clk), .src_in(noise[3:0]), .dest_clk(clk), .dest_out(several));
  xpm_cdc_async_rst #(.DEST_SYNC_FF(3), .RST_ACTIVE_HIGH(1)) reset (.src_arst(n < 8), .dest_clk(clk), .dest_arst(arst));
  always_ff @(posedge clk) begin
    history <= {history[6:0], noise[0]};
    words <= {words[7:0], noise[3:0]};
  end

  // Memory: a port writes and reads itself first, the other one reads a clock later with a register.
  wire [15:0] a, b;
  logic [15:0] memory[16], read_a = 0, read_b = 0, late_b = 0;
  initial foreach (memory[i]) memory[i] = 0;
  blk_mem_gen_v8_4_2 #(
      .C_MEM_TYPE(2), .C_BYTE_SIZE(8), .C_USE_BYTE_WEA(1), .C_WEA_WIDTH(2), .C_HAS_ENA(1), .C_WRITE_MODE_A("WRITE_FIRST"),
      .C_WRITE_MODE_B("READ_FIRST"), .C_WRITE_WIDTH_A(16), .C_READ_WIDTH_A(16), .C_WRITE_WIDTH_B(16), .C_READ_WIDTH_B(16),
      .C_WRITE_DEPTH_A(16), .C_READ_DEPTH_A(16), .C_WRITE_DEPTH_B(16), .C_READ_DEPTH_B(16), .C_ADDRA_WIDTH(4), .C_ADDRB_WIDTH(4),
      .C_HAS_MEM_OUTPUT_REGS_B(1)
  ) ram (
      .clka(clk), .ena(on), .wea(noise[13:12]), .addra({1'b0, noise[22:20]}), .dina(noise[15:0]), .douta(a),
      .clkb(clk), .web(1'b0), .addrb({1'b0, noise[26:24]}), .dinb(16'd0), .doutb(b)
  );
  logic [15:0] written;
  always_comb begin
    written = memory[{1'b0, noise[22:20]}];
    if (noise[12]) written[7:0] = noise[7:0];
    if (noise[13]) written[15:8] = noise[15:8];
  end
  always_ff @(posedge clk) begin
    if (on) begin
      memory[{1'b0, noise[22:20]}] <= written;
      read_a <= written;
    end
    read_b <= memory[{1'b0, noise[26:24]}];
    late_b <= read_b;
  end

  wire [15:0] differ = {
    b != late_b, a != read_a, several != words[11:8], arst != (n < 11), one != history[2], counted != expected_count,
    {end32, srl32} != {last[31], last[n[4:0]]}, srl16 != last[n[3:0]], {carries[3], sum} != {1'b0, noise[3:0]} + {1'b0, noise[7:4]} + {4'd0, noise[8]},
    f7 != (noise[2] ? noise[1] : noise[0]), {o6, o5} != {noise[5] ? |noise[4:0] : &noise[4:0], &noise[4:0]},
    lut6 != &noise[5:0], lut3 != ^noise[2:0], {fdpe, fdce} != {pe, ce}, {fdse, fdre} != {se, re}, back != noise[0]
  };
  initial wrong = 0;
  initial compared = 0;
  always_ff @(posedge clk) begin
    if (n > 4) wrong <= wrong | differ;
    compared <= compared + 1;
  end
endmodule
