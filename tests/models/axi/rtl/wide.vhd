-- Constants of more than 32 bits, which GHDL writes as text in Verilog, and those whose lower words are 0, which it takes for 0.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity wide is
  generic (
    enable : boolean := false;
    base   : std_logic_vector(31 downto 0) := (others => '0');
    bits   : std_logic_vector(3 downto 0) := "0000"
  );
  port (
    clk, rst_n : in  std_logic;
    choose     : in  std_logic_vector(2 downto 0);
    value      : in  std_logic_vector(31 downto 0);
    sum        : out std_logic_vector(63 downto 0);
    chosen     : out std_logic_vector(63 downto 0);
    count      : out std_logic_vector(47 downto 0);
    same       : out std_logic;
    settings   : out std_logic_vector(36 downto 0)
  );
end entity;

architecture rtl of wide is
  constant one : unsigned(63 downto 0) := x"3FF0_0000_0000_0000";
  signal counted : unsigned(47 downto 0);
  signal whole : unsigned(63 downto 0);
begin
  whole <= resize(unsigned(value), 64);
  sum <= std_logic_vector(whole + x"8000000000000001");
  same <= '1' when whole + one = x"3FF00000FFFF0001" else '0';
  count <= std_logic_vector(counted);
  settings <= '1' & bits & base when enable else (others => '0');

  with choose select chosen <=
    x"0123456789ABCDEF" when "000",
    x"0000000700000000" when "001",
    "1000000000000000000000000000000000000000000000000000000000000000" when "010",
    (others => '0') when "011",
    (others => '1') when "100",
    x"FFFFFFFF" & value when "101",
    64x"500000000" when others;

  process (clk)
  begin
    if rising_edge(clk) then
      counted <= counted + x"000100000001";
      if rst_n = '0' then counted <= x"FFFFFFFFFFF0"; end if;
    end if;
  end process;
end architecture;
