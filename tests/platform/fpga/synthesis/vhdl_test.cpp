// VHDL through GHDL and Yosys: what a folder of it becomes, and what is refused with file and line.
#include <fpga/synthesis/synthesis.h>
#include <fpga/synthesis/vhdl.h>

#include <boost/test/unit_test.hpp>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include <vp/error.h>

#include "temporary_files.h"

using namespace platform::synthesis;

namespace {

const PathTiming timing = PathTiming::load(std::string(MARKERVP_DATA) + "/rtl/xc7.json");

const std::string logic =
    "library ieee;\nuse ieee.std_logic_1164.all;\nuse ieee.numeric_std.all;\n";

/// A counter, in VHDL in which capitals do not matter.
const std::string counter = logic + R"(
Entity Counter is
  generic (Bits_g : positive := 8);
  port (Clk : in std_logic; Count : out std_logic_vector(Bits_g - 1 downto 0));
end entity;
architecture rtl of Counter is
  signal reg : unsigned(Count'range) := (others => '0');  -- a keyword of Verilog
begin
  Count <= std_logic_vector(reg);
  process (Clk) begin
    if rising_edge(Clk) then reg <= reg + 1; end if;
  end process;
end architecture;
)";

struct Folder {
  void write(const std::string& name, const std::string& text) {
    kit::write_file(folder / name, text);
  }
  Design design(const std::string& top, const Parameters& parameters = {}) {
    return {top, top, sources_in(folder.path()), parameters};
  }
  Figures figures(const std::string& top, const Parameters& parameters = {}) {
    return synthesise(design(top, parameters), timing);
  }
  std::string refusal(const std::string& top, const Parameters& parameters = {}) {
    try {
      figures(top, parameters);
    } catch (const vp::InputError& error) {
      return error.what();
    }
    return "";
  }

  kit::TemporaryFolder folder;
};

void check_says(const std::string& refusal, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    BOOST_TEST(refusal.find(part) != std::string::npos, refusal << " without " << part);
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(vhdl, Folder)

// As the top, and inside another one.
BOOST_AUTO_TEST_CASE(an_entity_may_be_named_as_a_keyword_of_verilog) {
  std::string text = counter;
  for (std::size_t at; (at = text.find("Counter")) != std::string::npos;)
    text.replace(at, 7, "reg");
  for (std::size_t at; (at = text.find("signal reg")) != std::string::npos;)
    text.replace(at, 10, "signal own");
  for (const std::string used : {"(reg)", " reg + 1", "then reg "})
    text.replace(text.find(used) + used.find("reg"), 3, "own");
  write("reg.vhd", text);
  BOOST_TEST(figures("reg").netlist.cells.ff == 8u);
  write("outer.vhd", logic +
                         "entity outer is port (clk : in std_logic; q : out std_logic_vector(7 "
                         "downto 0)); end;\narchitecture rtl of outer is begin\n"
                         "  inner: entity work.reg port map (clk, q);\nend;\n");
  BOOST_TEST(figures("outer").netlist.cells.ff == 8u);
}

BOOST_AUTO_TEST_CASE(a_counter_has_the_figures_of_its_generics) {
  write("counter.vhd", counter);
  BOOST_TEST(figures("Counter").netlist.cells.ff == 8u);
  const Figures wide = figures("counter", {{"Bits_g", 32}});
  BOOST_TEST(wide.netlist.cells.ff == 32u);
  BOOST_TEST(wide.netlist.cells.carry4 == 8u);
  BOOST_TEST(wide.parameters.at("Bits_g") == 32);
  // Figures belong to the VHDL, not to what GHDL makes of it.
  BOOST_REQUIRE(wide.sources.size() == 1u);
  BOOST_TEST(wide.sources.begin()->first == "counter.vhd");
}

BOOST_AUTO_TEST_CASE(a_boolean_generic_takes_a_word) {
  write("own.vhd", logic + R"(
entity own is
  generic (Enable, Fast_g : Boolean := false; Size : natural := 1);
  port (a, b : in std_logic; q : out std_logic);
end;
architecture rtl of own is
begin
  q <= a and b when Fast_g else '0';
end;
)");
  BOOST_TEST(figures("own").netlist.constant_bits == 1u);
  const Parameters fast = parse_parameters({"Fast_g=true", "Size=1"});
  BOOST_TEST(fast.at("Fast_g") == 1);
  BOOST_TEST(figures("own", fast).netlist.constant_bits == 0u);
}

// GHDL takes numbers without a point only.
BOOST_AUTO_TEST_CASE(a_real_generic_takes_a_number) {
  write("own.vhd", logic + R"(
entity own is
  generic (Rate : Real range 1.0 to 1.0e9; Part_g : real := 0.5);
  port (clk : in std_logic; d : in std_logic; q : out std_logic);
end;
architecture rtl of own is
  constant length : positive := integer(Rate * Part_g);
  signal line : std_logic_vector(length downto 1);
begin
  process (clk, d) begin
    if d = '0' then line <= (others => '0');
    elsif rising_edge(clk) then line <= line(length - 1 downto 1) & d; end if;
  end process;
  q <= line(length);
end;
)");
  BOOST_TEST(figures("own", {{"Rate", 20}}).netlist.cells.ff == 10u);
  BOOST_TEST(figures("own", {{"rate", 6}, {"PART_G", 2}}).netlist.cells.ff == 12u);
  check_says(refusal("own"), {"\"rate\" has no default value", "--parameter"});
}

// The top comes first by its name, its package last, and both are in a library.
BOOST_AUTO_TEST_CASE(sources_come_in_any_order_and_in_their_library) {
  write("a_top.vhd", logic + R"(
library mine;
use mine.sizes.all;
entity top is
  port (clk : in std_logic; q : out std_logic_vector(width - 1 downto 0));
end;
architecture rtl of top is
begin
  c : entity work.counter generic map (bits_g => width) port map (clk => clk, count => q);
end;
)");
  write("counter.vhdl", counter);
  write("sizes.vhd", "package sizes is constant width : positive := 12; end package;\n");
  // What the top does not need is no obstacle.
  write("bench.vhd",
        "entity bench is end; architecture a of bench is begin wait for 0.5ns; end;\n");
  write("broken.sv", "module broken(input logic a;\n");
  BOOST_TEST(figures("top").netlist.cells.ff == 12u);
}

// GHDL's Verilog lacks the branch for others; without it there would be latches, or other values.
BOOST_AUTO_TEST_CASE(a_case_keeps_its_others) {
  write("choice.vhd", logic + R"(
entity choice is
  port (a : in std_logic_vector(1 downto 0); d : in std_logic_vector(3 downto 0);
        q : out std_logic_vector(3 downto 0));
end;
architecture rtl of choice is
begin
  process (all) begin
    case a is
      when "00" => q <= d;
      when "01" => q <= not d;
      when others => q <= "1010";
    end case;
  end process;
end;
)");
  const Figures found = figures("choice");
  BOOST_TEST(found.netlist.cells.ff == 0u);
  BOOST_TEST(found.netlist.cells.lut == 4u);
}

// The common template of vendors; Yosys takes it for one that Virtex-6 cannot build.
// GHDL takes a constant of 64 bits whose lower half is 0 for 0. What it makes of one alone is put
// right; what it reckons from one is not known.
BOOST_AUTO_TEST_CASE(what_is_reckoned_from_a_lost_constant_is_refused) {
  const auto source = [&](const std::string& value) {
    write("lost.vhd", logic +
                          "entity lost is port (a, z : out std_logic_vector(63 downto 0)); "
                          "end;\narchitecture rtl of lost is\n"
                          "  constant one : unsigned(63 downto 0) := x\"3FF0000000000000\";\n"
                          "begin\n  z <= (others => '0');\n  a <= std_logic_vector(" +
                          value + ");\nend;\n");
  };
  source("one");
  BOOST_TEST(refusal("lost") == "");
  source("one + 1");
  check_says(refusal("lost"),
             {"lost.vhd:6: x\"3FF0000000000000\"", "takes such a constant for 0", "signal"});
}

BOOST_AUTO_TEST_CASE(a_memory_with_two_clocks_that_reads_first_is_a_block_ram) {
  write("ram.vhd", logic + R"(
entity ram is
  port (clk_a, clk_b, we_a, we_b : in std_logic; a, b : in unsigned(9 downto 0);
        da, db : in std_logic_vector(17 downto 0); qa, qb : out std_logic_vector(17 downto 0));
end;
architecture rtl of ram is
  type memory is array (0 to 1023) of std_logic_vector(17 downto 0);
  shared variable words : memory;
begin
  process (clk_a) begin
    if rising_edge(clk_a) then
      qa <= words(to_integer(a));
      if we_a = '1' then words(to_integer(a)) := da; end if;
    end if;
  end process;
  process (clk_b) begin
    if rising_edge(clk_b) then
      qb <= words(to_integer(b));
      if we_b = '1' then words(to_integer(b)) := db; end if;
    end if;
  end process;
end;
)");
  const Figures found = figures("ram");
  BOOST_TEST(found.netlist.cells.ramb18 == 1u);
  BOOST_TEST(found.netlist.cells.ramb36 == 0u);
  BOOST_TEST(found.netlist.cells.lut == 0u);
}

BOOST_AUTO_TEST_CASE(older_vhdl_is_read_where_it_is_no_vhdl_2008) {
  write("old.vhd", logic + R"(
entity old is port (default, b : in std_logic; q : out std_logic); end;
architecture rtl of old is
begin
  q <= default and b;
end;
)");
  BOOST_TEST(figures("old").netlist.cells.lut == 1u);
}

BOOST_AUTO_TEST_CASE(what_ghdl_refuses_is_told_with_file_line_and_what_to_do) {
  write("own.vhd", logic +
                       "entity own is\n  port (clk : in std_logc);\nend;\n"
                       "architecture rtl of own is\nbegin\nend;\n");
  check_says(refusal("own"), {"'own': ", "own.vhd:5:", "std_logc", "mend what it says"});
  write("own.vhd", logic +
                       "entity own is\n  generic (size : positive);\n"
                       "  port (q : out std_logic_vector(size downto 0));\nend;\n"
                       "architecture rtl of own is\nbegin\n  q <= (others => '1');\nend;\n");
  check_says(refusal("own"), {"own.vhd:5:", "\"size\" has no default value", "--parameter"});
  BOOST_TEST(refusal("own", {{"size", 3}}) == "");
  write("own.vhd",
        "library xpm;\nuse xpm.vcomponents.all;\nentity own is end;\n"
        "architecture rtl of own is\nbegin\nend;\n");
  check_says(refusal("own"), {"own.vhd:1:", "add the sources of the library 'xpm'", "vendor's"});
}

BOOST_AUTO_TEST_CASE(simple_primitives_of_unisim_are_there) {
  const auto own = [this](const std::string& instance) {
    write("own.vhd",
          "library ieee;\nuse ieee.std_logic_1164.all;\nlibrary UNISIM;\n"
          "use UNISIM.VComponents.all;\nentity own is\n"
          "  port (clk, d : in std_logic; q : out std_logic);\nend;\n"
          "architecture rtl of own is\nbegin\n  i : " +
              instance + ";\nend;\n");
  };
  own("FDRE port map (C => clk, D => d, CE => '1', R => '0', Q => q)");
  BOOST_TEST(refusal("own") == "");
  own("OSERDESE2 port map (CLK => clk, D1 => d, OQ => q)");
  check_says(refusal("own"), {"own.vhd:10:", "oserdese2"});
}

BOOST_AUTO_TEST_CASE(a_port_without_bits_is_0) {
  write("own.vhd",
        logic +
            "entity own is\n  generic (wide : natural := 0);\n"
            "  port (clk : in std_logic; a : in std_logic_vector(wide - 1 downto 0);\n"
            "    q : out std_logic_vector(wide - 1 downto 0); x : out std_logic);\nend;\n"
            "architecture rtl of own is\n"
            "  signal b : std_logic_vector(wide downto 0) := (others => '0');\nbegin\n"
            "  process (clk) begin\n    if rising_edge(clk) then\n"
            "      b <= not b(wide) & a;\n    end if;\n  end process;\n"
            "  q <= b(wide - 1 downto 0);\n  x <= b(wide);\nend;\n");
  const Figures none = figures("own"), three = figures("own", {{"wide", 3}});
  BOOST_TEST(none.netlist.cells.ff == 1u);
  BOOST_TEST(three.netlist.cells.ff == 4u);
  BOOST_TEST(none.netlist.constant_bits == 1u);  // q
}

BOOST_AUTO_TEST_CASE(options_reach_ghdl) {
  write("counter.vhd", counter);
  Design own = design("Counter");
  own.ghdl_options = {"--no-such-option"};
  std::string refused;
  try {
    synthesise(own, timing);
  } catch (const vp::InputError& error) {
    refused = error.what();
  }
  check_says(refused, {"no-such-option"});
  own.ghdl_options = {"-fexplicit"};
  BOOST_TEST(synthesise(own, timing).netlist.cells.ff == 8u);
  own.ghdl_options = {"a;b"};
  BOOST_CHECK_THROW(synthesise(own, timing), vp::InputError);
}

// GHDL takes a constant of 64 bits for 0 if only its highest 32 are not all 0.
BOOST_AUTO_TEST_CASE(constants_that_were_lost_are_restored_or_told) {
  const auto source = [](const std::string& declared, const std::string& value) {
    return logic +
           "entity mask is\n  port (d : in unsigned(63 downto 0); q : out unsigned(63 downto 0));\n"
           "end;\narchitecture rtl of mask is\n  " +
           declared + "\nbegin\n  q <= d xor " + value + ";\nend;\n";
  };
  const kit::TemporaryFolder made;
  const auto translated = [&](const std::string& declared, const std::string& value) {
    write("mask.vhd", source(declared, value));
    return kit::read_file(verilog_of(design("mask"), made.path()).sources.front());
  };
  const std::string zeros(63, '0');
  std::ostringstream said;
  std::streambuf* const usual = std::cerr.rdbuf(said.rdbuf());
  const std::string restored =
      translated("constant high : unsigned(63 downto 0) := (63 => '1', others => '0');", "high");
  const std::string zero =
      translated("constant none : unsigned(63 downto 0) := (others => '0');", "none");
  const std::string silent = said.str();
  const std::string told = translated("", "(unsigned'(x\"80000000\") * unsigned'(x\"80000000\"))");
  std::cerr.rdbuf(usual);
  BOOST_TEST(restored.find("64'b1" + zeros) != restored.npos, restored);
  BOOST_TEST(zero.find("64'b0" + zeros) != zero.npos, zero);
  BOOST_TEST(silent == "");
  BOOST_TEST(told.find("64'b0" + zeros) != told.npos, told);
  check_says(said.str(), {"warning: mask:", "constants of 64 bits that came out as 0"});
  write("mask.vhd", source("", "shift_left(to_unsigned(1, 64), 63)"));
  check_says(refusal("mask"), {"mask.vhd:10", "shift_left", "write it as one literal"});
}

BOOST_AUTO_TEST_CASE(a_top_that_is_not_there_or_twice_is_refused) {
  write("counter.vhd", counter);
  check_says(refusal("conter"), {"no module or entity 'conter'", "name Counter"});
  write("counter.sv", "module counter(input logic clk); endmodule\n");
  check_says(refusal("counter"), {"counter.vhd", "a module of", "counter.sv"});
}

// GHDL makes an empty module of it.
BOOST_AUTO_TEST_CASE(a_component_without_entity_is_refused) {
  const std::string part = logic + R"(
entity part is port (clk : in std_logic; q : out std_logic); end entity;
architecture rtl of part is
begin
  process begin
    wait for 500 ns;
  end process;
  q <= clk;
end architecture;
)";
  write("top.vhd", logic + R"(
entity top is port (clk : in std_logic; q : out std_logic); end entity;
architecture rtl of top is
  component part is port (clk : in std_logic; q : out std_logic); end component;
  signal inner : std_logic;
begin
  one : part port map (clk => clk, q => inner);
  process (clk) begin
    if rising_edge(clk) then q <= inner; end if;
  end process;
end architecture;
)");
  check_says(refusal("top"),
             {"GHDL cannot synthesise 'top': 'part' would be empty: add its source"});
  std::string broken = part;
  write("part.vhd", broken.replace(broken.find("500 ns"), 6, "500ns"));
  check_says(refusal("top"), {"part.vhd:9:", "space is required between number and unit name",
                              "'part' would be empty"});
  std::string right = part;
  const std::size_t process = right.find("  process begin"), end = right.find("  q <=");
  write("part.vhd", right.erase(process, end - process));
  BOOST_TEST(figures("top").netlist.cells.ff == 1u);
}

BOOST_AUTO_TEST_CASE(a_memory_is_read_from_a_file_of_text) {
  std::string text = kit::read_file(MARKERVP_SOURCE "/tests/models/axi/rtl/text_rom.vhd");
  write("text_rom.vhd", text);
  check_says(refusal("text_rom"), {"text_rom.vhd:15:", "cannot open file: ./bits.mem",
                                   "there is no file './bits.mem' beside the source"});
  std::filesystem::create_directory(folder / "data");
  write("data/bits.mem", "00000000\n00000001\n00000010\n00000011\n");
  const Figures made = figures("text_rom");
  BOOST_TEST(made.netlist.cells.ff > 2u);
  BOOST_TEST(made.sources.count("bits.mem") == 1u);
}

BOOST_AUTO_TEST_SUITE_END()
