-- What GHDL loses or misspells when it writes Verilog: the others of selections, and names that are keywords there.
library ieee;
use ieee.std_logic_1164.all;

entity choice is
  port (
    clk, rst_n, go : in  std_logic;
    sel            : in  std_logic_vector(2 downto 0);
    reg            : in  std_logic_vector(3 downto 0);
    output         : out std_logic_vector(3 downto 0);
    pulse          : out std_logic
  );
end entity;

architecture rtl of choice is
  type state_t is (idle, first, second);
  signal state : state_t;
begin
  with sel select output <=
    "1010" when "000",
    "0101" when "001",
    reg when others;

  process (clk)
  begin
    if rising_edge(clk) then
      pulse <= '0';
      case state is
        when idle => if go = '1' then state <= first; end if;
        when first => pulse <= '1'; state <= second;
        when others => state <= idle;
      end case;
      if rst_n = '0' then state <= idle; end if;
    end if;
  end process;
end architecture;
