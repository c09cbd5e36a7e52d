// A word on its way from the pixel clock to the system clock: held in a register beside a toggle that
// the system side samples on each of its edges. No handshake: a word that the next one overwrites
// before it was seen is lost.
module crossing_register #(
    parameter int BITS = 32
) (
    input  logic            clk,
    input  logic            rst,
    input  logic            send,
    input  logic [BITS-1:0] data,
    input  logic            seen,
    output logic            toggle,
    output logic [BITS-1:0] word,
    output logic            lost
);
  wire free = seen == toggle;
  assign lost = send && !free;

  always_ff @(posedge clk)
    if (rst) toggle <= 1'b0;
    else if (send) begin
      word <= data;
      if (free) toggle <= !toggle;
    end
endmodule
