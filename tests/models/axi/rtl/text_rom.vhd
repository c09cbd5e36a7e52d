-- A memory that is read from a file of its own, which lies below the source.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use std.textio.all;

entity text_rom is
  generic (contents : string := "./bits.mem");
  port (clk : in std_logic; word : out std_logic_vector(7 downto 0));
end entity;

architecture rtl of text_rom is
  type memory_t is array (0 to 3) of bit_vector(7 downto 0);
  impure function read_words(name : string) return memory_t is
    file text_file : text open read_mode is name;
    variable one : line;
    variable words : memory_t;
  begin
    for i in words'range loop
      readline(text_file, one);
      read(one, words(i));
    end loop;
    return words;
  end function;
  signal memory : memory_t := read_words(contents);
  signal at : unsigned(1 downto 0) := "00";
begin
  process (clk) begin
    if rising_edge(clk) then
      at <= at + 1;
      word <= to_stdlogicvector(memory(to_integer(at)));
    end if;
  end process;
end architecture;
