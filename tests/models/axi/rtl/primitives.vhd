-- Primitives of the library unisim beside what they should do.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
library unisim;
use unisim.vcomponents.all;

entity primitives is
  generic (broken : boolean := false);
  port (clk : in std_logic; wrong : out std_logic_vector(7 downto 0); compared : out std_logic_vector(15 downto 0));
end;

architecture rtl of primitives is
  signal noise : std_logic_vector(15 downto 0) := x"1234";
  signal count : integer range 0 to 65535 := 0;
  signal errors : std_logic_vector(7 downto 0) := (others => '0');
  signal buffered, enable, start, data, p, m, back, fdre_q, fdse_q, fdce_q, fdpe_q, sum : std_logic;
  signal re, se, ce, pe : std_logic := '1';
  function differ(a, b : std_logic) return std_logic is
  begin
    return a xor b;
  end;
begin
  enable <= noise(3);
  start <= noise(9) and noise(11);
  data <= not noise(0) when broken else noise(0);
  clock_buffer : BUFG port map (O => buffered, I => clk);
  to_pins : OBUFDS generic map (IOSTANDARD => "TMDS_33") port map (O => p, OB => m, I => noise(0));
  from_pins : IBUFDS generic map (DIFF_TERM => true) port map (O => back, I => p, IB => m);
  fdre_i : FDRE generic map (INIT => '1') port map (Q => fdre_q, C => buffered, CE => enable, R => start, D => data);
  fdse_i : FDSE port map (Q => fdse_q, C => buffered, CE => enable, S => start, D => noise(0));
  fdce_i : FDCE generic map (INIT => '1') port map (Q => fdce_q, C => buffered, CE => enable, CLR => start, D => noise(0));
  fdpe_i : FDPE port map (Q => fdpe_q, C => buffered, CE => enable, PRE => start, D => noise(0));
  lut3_i : LUT3 generic map (INIT => x"96") port map (O => sum, I0 => noise(0), I1 => noise(1), I2 => noise(2));

  process (buffered)
  begin
    if rising_edge(buffered) then
      noise <= noise(14 downto 0) & (noise(15) xor noise(13) xor noise(12) xor noise(10));
      if count < 65535 then
        count <= count + 1;
      end if;
      if start = '1' then
        re <= '0';
        se <= '1';
      elsif enable = '1' then
        re <= noise(0);
        se <= noise(0);
      end if;
      if start = '0' and enable = '1' then
        ce <= noise(0);
        pe <= noise(0);
      elsif start = '1' then
        ce <= '0';
        pe <= '1';
      end if;
      errors(0) <= errors(0) or differ(fdre_q, re);
      errors(1) <= errors(1) or differ(fdse_q, se);
      -- While an asynchronous input is active, only the primitive shows it at once.
      errors(2) <= errors(2) or (differ(fdce_q, ce) and not start);
      errors(3) <= errors(3) or (differ(fdpe_q, pe) and not start);
      errors(4) <= errors(4) or (start and (fdce_q or not fdpe_q));
      errors(5) <= errors(5) or differ(back, noise(0)) or not differ(p, m);
      errors(6) <= errors(6) or differ(sum, noise(0) xor noise(1) xor noise(2));
    end if;
  end process;
  wrong <= errors;
  compared <= std_logic_vector(to_unsigned(count, 16));
end;
