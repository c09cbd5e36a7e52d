// A stream through a register whose outputs come from flip-flops alone, and a reset that needs no clock.
module registered (
    input  logic        clk,
    input  logic        rst_n,
    input  logic [31:0] in_tdata,
    input  logic        in_tvalid,
    input  logic        in_tlast,
    output logic        in_tready,
    output logic [31:0] out_tdata,
    output logic        out_tvalid,
    output logic        out_tlast,
    input  logic        out_tready,
    output logic [ 7:0] words
);
  wire [31:0] next = in_tdata + 32'd1;  // logic behind inputs that ends in registers
  always_ff @(posedge clk or negedge rst_n)
    if (!rst_n) begin
      in_tready <= 1'b0;
      out_tvalid <= 1'b0;
      words <= 8'd0;
    end else begin
      in_tready <= !out_tvalid && !(in_tvalid && in_tready);
      if (in_tvalid && in_tready) begin
        out_tdata  <= next;
        out_tlast  <= in_tlast;
        out_tvalid <= 1'b1;
        words <= words + 8'd1;
      end else if (out_tready) out_tvalid <= 1'b0;
    end
endmodule
