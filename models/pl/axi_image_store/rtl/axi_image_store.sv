// AXI Image Store (thesis 4.3.3, ports of table B.8): writes the image that arrives on its stream into
// port A of the BRAM, from address 0 on after each rise of `ena`. System clock.
module axi_image_store #(
    parameter int ADDRESS_BITS = 17  // of words of four pixels
) (
    input  logic                    clk,
    input  logic                    ena,         // the control packet's wr_en
    input  logic                    rst,
    input  logic [            31:0] m_tdata,
    input  logic                    m_tvalid,
    output logic                    m_tready,
    output logic                    bram_we,
    output logic [ADDRESS_BITS-1:0] bram_addr,   // words stored since the last rise of `ena`
    output logic [            31:0] bram_din
);
  wire enabled = ena && !rst;
  logic ena_before;

  assign bram_we  = m_tvalid && m_tready;
  assign bram_din = m_tdata;

  always_ff @(posedge clk) begin
    ena_before <= enabled;
    m_tready   <= enabled;
    if (rst || (enabled && !ena_before)) bram_addr <= '0;
    else if (bram_we) bram_addr <= bram_addr + 1'b1;
  end
endmodule
