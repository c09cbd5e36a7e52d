-- Global Threshold (thesis 4.3.5) in VHDL: the same words on the same clocks as the model.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity global_threshold is
  generic (
    WIDTH  : positive := 640;
    HEIGHT : positive := 480);
  port (
    clk              : in  std_logic;
    por              : in  std_logic;                      -- system reset
    rst              : in  std_logic;                      -- the threshold survives it
    frame_ena        : in  std_logic;
    wr_thresh        : in  std_logic;                      -- a level: loads `threshold` on every clock
    threshold        : in  std_logic_vector(7 downto 0);
    pixel            : in  std_logic_vector(7 downto 0);
    x                : in  std_logic_vector(9 downto 0);
    y                : in  std_logic_vector(8 downto 0);
    binary_ena       : out std_logic;
    binary_out       : out std_logic;                      -- 1 is dark
    binary_x         : out std_logic_vector(9 downto 0);
    binary_y         : out std_logic_vector(8 downto 0);
    thresh_out       : out std_logic;
    thresh_data      : out std_logic_vector(31 downto 0);  -- bit i is pixel 32w + i
    active_threshold : out std_logic_vector(7 downto 0));  -- for reports
end entity;

architecture rtl of global_threshold is
  subtype count_t is unsigned(19 downto 0);
  type histogram_t is array (0 to 255) of count_t;

  signal histogram    : histogram_t;
  signal counted      : std_logic_vector(255 downto 0) := (others => '0');  -- counters with something of this frame
  signal count        : count_t;
  signal dark_count   : count_t := (others => '0');
  signal bright_count : count_t := (others => '0');
  signal dark_peak    : unsigned(7 downto 0) := to_unsigned(0, 8);
  signal bright_peak  : unsigned(7 downto 0) := to_unsigned(255, 8);
  signal level        : unsigned(7 downto 0) := to_unsigned(127, 8);
  signal middle       : unsigned(8 downto 0);
  signal word         : std_logic_vector(31 downto 0);
  signal next_word    : std_logic_vector(31 downto 0);
  signal frame_before : std_logic := '0';
  signal dark         : std_logic;
  signal last_of_word : boolean;
begin
  assert WIDTH mod 32 = 0 and WIDTH * HEIGHT < 2 ** count_t'length
    report "a line is whole words, and a frame has fewer than 2**20 pixels" severity failure;

  dark         <= '1' when unsigned(pixel) <= level else '0';
  next_word    <= dark & word(31 downto 1);
  last_of_word <= x(4 downto 0) = "11111";
  count        <= histogram(to_integer(unsigned(pixel))) + 1 when counted(to_integer(unsigned(pixel))) = '1'
                  else to_unsigned(1, count_t'length);
  middle       <= ('0' & dark_peak) + ('0' & bright_peak);

  active_threshold <= std_logic_vector(level);

  words : process (clk)
  begin
    if rising_edge(clk) then
      if por = '1' or rst = '1' then
        frame_before <= '0';
        binary_ena   <= '0';
        thresh_out   <= '0';
      else
        frame_before <= frame_ena;
        binary_ena   <= frame_ena;
        thresh_out   <= '0';
        if frame_ena = '1' then
          binary_out <= dark;
          binary_x   <= x;
          binary_y   <= y;
          word       <= next_word;
          if last_of_word then
            thresh_out  <= '1';
            thresh_data <= next_word;
          end if;
        end if;
      end if;
    end if;
  end process;

  counting : process (clk)
  begin
    if rising_edge(clk) then
      if frame_ena = '1' then
        histogram(to_integer(unsigned(pixel))) <= count;
      end if;
      if por = '1' or rst = '1' or (frame_before = '1' and frame_ena = '0') then
        counted      <= (others => '0');
        dark_count   <= (others => '0');
        bright_count <= (others => '0');
        dark_peak    <= to_unsigned(0, 8);
        bright_peak  <= to_unsigned(255, 8);
      elsif frame_ena = '1' then
        counted(to_integer(unsigned(pixel))) <= '1';
        -- The most frequent level of each half, replaced by a strictly greater count only.
        if pixel(7) = '0' and count > dark_count then
          dark_count <= count;
          dark_peak  <= unsigned(pixel);
        end if;
        if pixel(7) = '1' and count > bright_count then
          bright_count <= count;
          bright_peak  <= unsigned(pixel);
        end if;
      end if;
    end if;
  end process;

  threshold_in_use : process (clk)
  begin
    if rising_edge(clk) then
      if por = '1' then
        level <= to_unsigned(127, 8);
      elsif rst = '0' then
        if wr_thresh = '1' then
          level <= unsigned(threshold);
        elsif frame_before = '1' and frame_ena = '0' then
          level <= middle(8 downto 1);
        end if;
      end if;
    end if;
  end process;
end architecture;
