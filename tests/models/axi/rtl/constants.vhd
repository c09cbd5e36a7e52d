-- Constants of 64 bits of which only the highest 32 are not all 0, in every form in which GHDL loses them, and zeros beside them.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity constants is
  port (
    clk    : in  std_logic;
    choose : in  std_logic_vector(2 downto 0);
    value  : in  std_logic_vector(63 downto 0);
    chosen : out std_logic_vector(63 downto 0);
    same   : out std_logic;
    kept   : out std_logic_vector(63 downto 0)
  );
end entity;

architecture rtl of constants is
  type settings is record
    low  : std_logic_vector(31 downto 0);
    high : std_logic_vector(63 downto 0);
  end record;
  constant several : std_logic_vector(63 downto 0) := (63 | 40 => '1', others => '0');
  constant word    : std_logic_vector(63 downto 0) := (63 downto 32 => '1', others => '0');
  constant zero    : std_logic_vector(63 downto 0) := (others => '0');
  constant reset   : settings := (low => x"00000000", high => (62 => '1', others => '0'));
  signal state : std_logic_vector(63 downto 0) := (61 => '1', others => '0');

  function bit_of(number : natural) return std_logic_vector is
    variable bits : std_logic_vector(63 downto 0) := (others => '0');
  begin
    bits(number) := '1';
    return bits;
  end function;
begin
  kept <= state;
  same <= '1' when value = several else '0';

  with choose select chosen <=
    several when "000",
    word when "001",
    zero when "010",
    reset.high when "011",
    bit_of(60) when "100",
    x"4000000000000000" when "101",
    x"0000000000000000" when "110",
    word xor value when others;

  process (clk)
  begin
    if rising_edge(clk) then
      if choose = "111" then state <= (others => '0'); end if;
    end if;
  end process;
end architecture;
