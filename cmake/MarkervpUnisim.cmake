# Primitives of the chip (UG953) that VHDL takes from the vendor's library unisim: those that have a simple model. GHDL refuses others by
# name, and so does `markervp import`.
set(markervp_unisim [==[
library ieee;
use ieee.std_logic_1164.all;
package vcomponents is
component BUFG
  port (O : out std_logic; I : in std_logic);
end component;
component BUFH
  port (O : out std_logic; I : in std_logic);
end component;
component BUFIO
  port (O : out std_logic; I : in std_logic);
end component;
component BUFR
  generic (BUFR_DIVIDE : string := "BYPASS"; SIM_DEVICE : string := "7SERIES");
  port (O : out std_logic; CE : in std_logic; CLR : in std_logic; I : in std_logic);
end component;
component BUFGMUX
  generic (CLK_SEL_TYPE : string := "SYNC");
  port (O : out std_logic; I0 : in std_logic; I1 : in std_logic; S : in std_logic);
end component;
component IBUF
  generic (CAPACITANCE : string := "DONT_CARE"; IBUF_DELAY_VALUE : string := "0"; IBUF_LOW_PWR : boolean := true; IFD_DELAY_VALUE : string := "AUTO"; IOSTANDARD : string := "DEFAULT");
  port (O : out std_logic; I : in std_logic);
end component;
component IBUFG
  generic (CAPACITANCE : string := "DONT_CARE"; IBUF_DELAY_VALUE : string := "0"; IBUF_LOW_PWR : boolean := true; IFD_DELAY_VALUE : string := "AUTO"; IOSTANDARD : string := "DEFAULT");
  port (O : out std_logic; I : in std_logic);
end component;
component IBUFDS
  generic (DIFF_TERM : boolean := false; DQS_BIAS : string := "FALSE"; CAPACITANCE : string := "DONT_CARE"; IBUF_DELAY_VALUE : string := "0"; IBUF_LOW_PWR : boolean := true; IFD_DELAY_VALUE : string := "AUTO"; IOSTANDARD : string := "DEFAULT");
  port (O : out std_logic; I : in std_logic; IB : in std_logic);
end component;
component IBUFGDS
  generic (DIFF_TERM : boolean := false; DQS_BIAS : string := "FALSE"; CAPACITANCE : string := "DONT_CARE"; IBUF_DELAY_VALUE : string := "0"; IBUF_LOW_PWR : boolean := true; IFD_DELAY_VALUE : string := "AUTO"; IOSTANDARD : string := "DEFAULT");
  port (O : out std_logic; I : in std_logic; IB : in std_logic);
end component;
component OBUF
  generic (CAPACITANCE : string := "DONT_CARE"; DRIVE : integer := 12; IOSTANDARD : string := "DEFAULT"; SLEW : string := "SLOW");
  port (O : out std_logic; I : in std_logic);
end component;
component OBUFDS
  generic (CAPACITANCE : string := "DONT_CARE"; IOSTANDARD : string := "DEFAULT"; SLEW : string := "SLOW");
  port (O : out std_logic; OB : out std_logic; I : in std_logic);
end component;
component FDRE
  generic (INIT : bit := '0');
  port (Q : out std_logic; C : in std_logic; CE : in std_logic; D : in std_logic; R : in std_logic);
end component;
component FDSE
  generic (INIT : bit := '1');
  port (Q : out std_logic; C : in std_logic; CE : in std_logic; D : in std_logic; S : in std_logic);
end component;
component FDCE
  generic (INIT : bit := '0');
  port (Q : out std_logic; C : in std_logic; CE : in std_logic; D : in std_logic; CLR : in std_logic);
end component;
component FDPE
  generic (INIT : bit := '1');
  port (Q : out std_logic; C : in std_logic; CE : in std_logic; D : in std_logic; PRE : in std_logic);
end component;
component LUT1
  generic (INIT : bit_vector(1 downto 0) := (others => '0'));
  port (O : out std_logic; I0 : in std_logic);
end component;
component LUT2
  generic (INIT : bit_vector(3 downto 0) := (others => '0'));
  port (O : out std_logic; I0 : in std_logic; I1 : in std_logic);
end component;
component LUT3
  generic (INIT : bit_vector(7 downto 0) := (others => '0'));
  port (O : out std_logic; I0 : in std_logic; I1 : in std_logic; I2 : in std_logic);
end component;
component LUT4
  generic (INIT : bit_vector(15 downto 0) := (others => '0'));
  port (O : out std_logic; I0 : in std_logic; I1 : in std_logic; I2 : in std_logic; I3 : in std_logic);
end component;
component LUT5
  generic (INIT : bit_vector(31 downto 0) := (others => '0'));
  port (O : out std_logic; I0 : in std_logic; I1 : in std_logic; I2 : in std_logic; I3 : in std_logic; I4 : in std_logic);
end component;
component LUT6
  generic (INIT : bit_vector(63 downto 0) := (others => '0'));
  port (O : out std_logic; I0 : in std_logic; I1 : in std_logic; I2 : in std_logic; I3 : in std_logic; I4 : in std_logic; I5 : in std_logic);
end component;
end package;
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
entity BUFG is
  port (O : out std_logic; I : in std_logic);
end;
architecture model of BUFG is
begin
  O <= I;
end;
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
entity BUFH is
  port (O : out std_logic; I : in std_logic);
end;
architecture model of BUFH is
begin
  O <= I;
end;
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
entity BUFIO is
  port (O : out std_logic; I : in std_logic);
end;
architecture model of BUFIO is
begin
  O <= I;
end;
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
entity BUFR is
  generic (BUFR_DIVIDE : string := "BYPASS"; SIM_DEVICE : string := "7SERIES");
  port (O : out std_logic; CE : in std_logic; CLR : in std_logic; I : in std_logic);
end;
architecture model of BUFR is
begin
  assert BUFR_DIVIDE = "BYPASS" report "BUFR is modelled with BUFR_DIVIDE BYPASS only" severity failure;
  O <= I;
end;
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
entity BUFGMUX is
  generic (CLK_SEL_TYPE : string := "SYNC");
  port (O : out std_logic; I0 : in std_logic; I1 : in std_logic; S : in std_logic);
end;
architecture model of BUFGMUX is
begin
  O <= I1 when S = '1' else I0;
end;
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
entity IBUF is
  generic (CAPACITANCE : string := "DONT_CARE"; IBUF_DELAY_VALUE : string := "0"; IBUF_LOW_PWR : boolean := true; IFD_DELAY_VALUE : string := "AUTO"; IOSTANDARD : string := "DEFAULT");
  port (O : out std_logic; I : in std_logic);
end;
architecture model of IBUF is
begin
  O <= I;
end;
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
entity IBUFG is
  generic (CAPACITANCE : string := "DONT_CARE"; IBUF_DELAY_VALUE : string := "0"; IBUF_LOW_PWR : boolean := true; IFD_DELAY_VALUE : string := "AUTO"; IOSTANDARD : string := "DEFAULT");
  port (O : out std_logic; I : in std_logic);
end;
architecture model of IBUFG is
begin
  O <= I;
end;
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
entity IBUFDS is
  generic (DIFF_TERM : boolean := false; DQS_BIAS : string := "FALSE"; CAPACITANCE : string := "DONT_CARE"; IBUF_DELAY_VALUE : string := "0"; IBUF_LOW_PWR : boolean := true; IFD_DELAY_VALUE : string := "AUTO"; IOSTANDARD : string := "DEFAULT");
  port (O : out std_logic; I : in std_logic; IB : in std_logic);
end;
architecture model of IBUFDS is
begin
  O <= I;
end;
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
entity IBUFGDS is
  generic (DIFF_TERM : boolean := false; DQS_BIAS : string := "FALSE"; CAPACITANCE : string := "DONT_CARE"; IBUF_DELAY_VALUE : string := "0"; IBUF_LOW_PWR : boolean := true; IFD_DELAY_VALUE : string := "AUTO"; IOSTANDARD : string := "DEFAULT");
  port (O : out std_logic; I : in std_logic; IB : in std_logic);
end;
architecture model of IBUFGDS is
begin
  O <= I;
end;
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
entity OBUF is
  generic (CAPACITANCE : string := "DONT_CARE"; DRIVE : integer := 12; IOSTANDARD : string := "DEFAULT"; SLEW : string := "SLOW");
  port (O : out std_logic; I : in std_logic);
end;
architecture model of OBUF is
begin
  O <= I;
end;
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
entity OBUFDS is
  generic (CAPACITANCE : string := "DONT_CARE"; IOSTANDARD : string := "DEFAULT"; SLEW : string := "SLOW");
  port (O : out std_logic; OB : out std_logic; I : in std_logic);
end;
architecture model of OBUFDS is
begin
  O <= I;
  OB <= not I;
end;
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
entity FDRE is
  generic (INIT : bit := '0');
  port (Q : out std_logic; C : in std_logic; CE : in std_logic; D : in std_logic; R : in std_logic);
end;
architecture model of FDRE is
  signal bit_now : std_logic := to_stdulogic(INIT);
begin
  process (C) begin
    if rising_edge(C) then
      if R = '1' then bit_now <= '0';
      elsif CE = '1' then bit_now <= D; end if;
    end if;
  end process;
  Q <= bit_now;
end;
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
entity FDSE is
  generic (INIT : bit := '1');
  port (Q : out std_logic; C : in std_logic; CE : in std_logic; D : in std_logic; S : in std_logic);
end;
architecture model of FDSE is
  signal bit_now : std_logic := to_stdulogic(INIT);
begin
  process (C) begin
    if rising_edge(C) then
      if S = '1' then bit_now <= '1';
      elsif CE = '1' then bit_now <= D; end if;
    end if;
  end process;
  Q <= bit_now;
end;
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
entity FDCE is
  generic (INIT : bit := '0');
  port (Q : out std_logic; C : in std_logic; CE : in std_logic; D : in std_logic; CLR : in std_logic);
end;
architecture model of FDCE is
  signal bit_now : std_logic := to_stdulogic(INIT);
begin
  process (C, CLR) begin
    if CLR = '1' then bit_now <= '0';
    elsif rising_edge(C) then
      if CE = '1' then bit_now <= D; end if;
    end if;
  end process;
  Q <= bit_now;
end;
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
entity FDPE is
  generic (INIT : bit := '1');
  port (Q : out std_logic; C : in std_logic; CE : in std_logic; D : in std_logic; PRE : in std_logic);
end;
architecture model of FDPE is
  signal bit_now : std_logic := to_stdulogic(INIT);
begin
  process (C, PRE) begin
    if PRE = '1' then bit_now <= '1';
    elsif rising_edge(C) then
      if CE = '1' then bit_now <= D; end if;
    end if;
  end process;
  Q <= bit_now;
end;
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
entity LUT1 is
  generic (INIT : bit_vector(1 downto 0) := (others => '0'));
  port (O : out std_logic; I0 : in std_logic);
end;
architecture model of LUT1 is
  signal at : unsigned(0 downto 0);
  constant table : std_logic_vector(1 downto 0) := to_stdlogicvector(INIT);
begin
  at(0) <= I0;
  O <= table(to_integer(at));
end;
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
entity LUT2 is
  generic (INIT : bit_vector(3 downto 0) := (others => '0'));
  port (O : out std_logic; I0 : in std_logic; I1 : in std_logic);
end;
architecture model of LUT2 is
  signal at : unsigned(1 downto 0);
  constant table : std_logic_vector(3 downto 0) := to_stdlogicvector(INIT);
begin
  at <= I1 & I0;
  O <= table(to_integer(at));
end;
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
entity LUT3 is
  generic (INIT : bit_vector(7 downto 0) := (others => '0'));
  port (O : out std_logic; I0 : in std_logic; I1 : in std_logic; I2 : in std_logic);
end;
architecture model of LUT3 is
  signal at : unsigned(2 downto 0);
  constant table : std_logic_vector(7 downto 0) := to_stdlogicvector(INIT);
begin
  at <= I2 & I1 & I0;
  O <= table(to_integer(at));
end;
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
entity LUT4 is
  generic (INIT : bit_vector(15 downto 0) := (others => '0'));
  port (O : out std_logic; I0 : in std_logic; I1 : in std_logic; I2 : in std_logic; I3 : in std_logic);
end;
architecture model of LUT4 is
  signal at : unsigned(3 downto 0);
  constant table : std_logic_vector(15 downto 0) := to_stdlogicvector(INIT);
begin
  at <= I3 & I2 & I1 & I0;
  O <= table(to_integer(at));
end;
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
entity LUT5 is
  generic (INIT : bit_vector(31 downto 0) := (others => '0'));
  port (O : out std_logic; I0 : in std_logic; I1 : in std_logic; I2 : in std_logic; I3 : in std_logic; I4 : in std_logic);
end;
architecture model of LUT5 is
  signal at : unsigned(4 downto 0);
  constant table : std_logic_vector(31 downto 0) := to_stdlogicvector(INIT);
begin
  at <= I4 & I3 & I2 & I1 & I0;
  O <= table(to_integer(at));
end;
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
entity LUT6 is
  generic (INIT : bit_vector(63 downto 0) := (others => '0'));
  port (O : out std_logic; I0 : in std_logic; I1 : in std_logic; I2 : in std_logic; I3 : in std_logic; I4 : in std_logic; I5 : in std_logic);
end;
architecture model of LUT6 is
  signal at : unsigned(5 downto 0);
  constant table : std_logic_vector(63 downto 0) := to_stdlogicvector(INIT);
begin
  at <= I5 & I4 & I3 & I2 & I1 & I0;
  O <= table(to_integer(at));
end;
]==])

# With primitives where a source names their library, and the user gives none of his own.
function(markervp_vhdl_add_unisim RESULT)
  set(sources ${ARGN})
  set(is_used FALSE)
  foreach(source IN LISTS ARGN)
    file(STRINGS "${source}" found REGEX "^[ \t]*([Uu][Ss][Ee]|[Pp][Aa][Cc][Kk][Aa][Gg][Ee])[ \t]+([Uu][Nn][Ii][Ss][Ii][Mm][.])?[Vv][Cc][Oo][Mm][Pp][Oo][Nn][Ee][Nn][Tt][Ss]")
    if(found MATCHES "^[ \t]*[Uu]")
      set(is_used TRUE)
    elseif(found)
      set(${RESULT} ${ARGN} PARENT_SCOPE)
      return()
    endif()
  endforeach()
  if(is_used)
    file(WRITE "${FILE}.unisim.vhd" "${markervp_unisim}")
    list(APPEND sources "${FILE}.unisim.vhd")
  endif()
  set(${RESULT} ${sources} PARENT_SCOPE)
endfunction()
