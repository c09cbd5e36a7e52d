// A FIFO of eight words between two clocks: each side sees the other's pointer, in Gray code, two
// clocks of its own late.
module crossing (
    input logic s_axis_aclk,
    input logic s_axis_aresetn,
    input logic [31:0] s_axis_tdata,
    input logic s_axis_tlast,
    input logic s_axis_tvalid,
    output logic s_axis_tready,
    input logic m_axis_aclk,
    input logic m_axis_aresetn,
    output logic [31:0] m_axis_tdata,
    output logic m_axis_tlast,
    output logic m_axis_tvalid,
    input logic m_axis_tready
);
  logic [32:0] words[8];
  logic [3:0] write, write_gray, write_seen[2];
  logic [3:0] read, read_gray, read_seen[2];

  assign write_gray = write ^ (write >> 1);
  assign read_gray = read ^ (read >> 1);

  // Full: the pointers differ by all eight, which are the upper two bits of a Gray code.
  assign s_axis_tready = write_gray != (read_seen[1] ^ 4'b1100);
  always_ff @(posedge s_axis_aclk) begin
    read_seen <= '{read_gray, read_seen[0]};
    if (s_axis_tvalid && s_axis_tready) begin
      words[write[2:0]] <= {s_axis_tlast, s_axis_tdata};
      write <= write + 4'd1;
    end
    if (!s_axis_aresetn) begin
      write <= '0;
      read_seen <= '{default: '0};
    end
  end

  assign {m_axis_tlast, m_axis_tdata} = words[read[2:0]];
  assign m_axis_tvalid = read_gray != write_seen[1];
  always_ff @(posedge m_axis_aclk) begin
    write_seen <= '{write_gray, write_seen[0]};
    if (m_axis_tvalid && m_axis_tready) read <= read + 4'd1;
    if (!m_axis_aresetn) begin
      read <= '0;
      write_seen <= '{default: '0};
    end
  end
endmodule
