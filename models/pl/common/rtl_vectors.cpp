// Stimulus and response of an IP as files, and the test benches that read them.
#include <pl/common/rtl_model.h>

#include <algorithm>
#include <iterator>

#include <vp/clock_scheduler.h>
#include <vp/error.h>

namespace pl {

namespace {

struct Port {
  std::string name;
  unsigned bits;
};

/// What the texts of both benches are made of.
struct Bench {
  std::string ip;
  std::vector<std::string> clocks;
  std::vector<Port> inputs, outputs;
  std::vector<IpPorts::Parameter> parameters;
  std::uint64_t lines;

  /// The first column of stimulus where there are several clocks: which of them rise, the first one
  /// in the highest bit.
  std::vector<Port> rises() const {
    if (clocks.size() == 1) return {};
    return {{"rises", static_cast<unsigned>(clocks.size())}};
  }
};

constexpr const char* digits = "0123456789ABCDEF";

void append_hex(std::string& line, std::uint64_t value, unsigned bits) {
  for (unsigned digit = (bits + 3) / 4; digit-- > 0;) line += digits[value >> 4 * digit & 0xF];
  line += ' ';
}

/// `separator` between what `text` makes of each.
template <class Item, class Text>
std::string list(const std::vector<Item>& items, const std::string& separator, Text text) {
  std::string result;
  for (const Item& item : items) result += (result.empty() ? "" : separator) + text(item);
  return result;
}

std::string repeated(const std::string& text, std::size_t count) {
  std::string result;
  for (std::size_t i = 0; i < count; ++i) result += text;
  return result;
}

std::string name_of(const Port& port) {
  return port.name;
}

std::string as_it_is(const std::string& text) {
  return text;
}

std::string columns_text(const Bench& bench) {
  if (bench.rises().empty()) return "";
  return "; the first one of stimulus: which of " + list(bench.clocks, ", ", as_it_is) + " rise";
}

/// `text` with each `{key}` replaced.
std::string filled(std::string text,
                   const std::vector<std::pair<std::string, std::string>>& values) {
  for (const auto& [key, value] : values) {
    const std::string place = "{" + key + "}";
    for (std::size_t at = text.find(place); at != std::string::npos;
         at = text.find(place, at + value.size()))
      text.replace(at, place.size(), value);
  }
  return text;
}

constexpr const char* verilog =
    R"(// Made by markervp: plays stimulus.hex to {ip}, and compares it with response.hex. A line is a clock,
// a column a port{columns}. What an output need not be is X there.
//   iverilog -g2012 -s bench -o bench.vvp bench.sv YOUR_FILES && vvp -n bench.vvp
`timescale 1ns / 1ps
module bench;
  localparam CLOCKS = {lines};
{clocks}
{declarations}
  {ip} {parameters}dut ({connections});

  integer stimulus, response, clock, failed = 0;
  initial begin
    if ($test$plusargs("trace")) begin
      $dumpfile("bench.vcd");
      $dumpvars(0, bench);
    end
    stimulus = $fopen("stimulus.hex", "r");
    response = $fopen("response.hex", "r");
    for (clock = 1; clock <= CLOCKS && !failed; clock = clock + 1) begin
      if (stimulus == 0 || $fscanf(stimulus, "{input_formats}", {inputs}) != {input_count} ||
          response == 0 || $fscanf(response, "{output_formats}", {expected}) != {output_count}) begin
        $display("FAIL: clock %0d is not in stimulus.hex or response.hex", clock);
        failed = 1;
      end else begin
        #5 {raise};
        #5;
{comparisons}
        {lower};
      end
    end
    if (failed) $fatal(1, "{ip} differs");
    $display("PASS: equal on %0d clocks", CLOCKS);
    $finish;
  end
endmodule
)";

std::string verilog_bench(const Bench& bench) {
  const auto range = [](const Port& port) {
    return port.bits == 1 ? std::string() : "[" + std::to_string(port.bits - 1) + ":0] ";
  };
  const auto connection = [](const std::string& name) { return "." + name + "(" + name + ")"; };
  const auto port_connection = [&](const Port& port) { return connection(port.name); };
  const bool several = bench.clocks.size() > 1;
  const std::string all_clocks =
      several ? "{" + list(bench.clocks, ", ", as_it_is) + "}" : bench.clocks.front();
  std::vector<Port> stimulus = bench.rises();
  std::string declarations, comparisons;
  for (const Port& port : stimulus) declarations += "  logic " + range(port) + port.name + ";\n";
  stimulus.insert(stimulus.end(), bench.inputs.begin(), bench.inputs.end());
  for (const Port& port : bench.inputs)
    declarations += "  logic " + range(port) + port.name + ";\n";
  for (const Port& port : bench.outputs) {
    declarations += "  wire " + range(port) + port.name + ";\n  logic " + range(port) +
                    "expected_" + port.name + ";\n";
    comparisons += filled(
        "        if (({name} ==? expected_{name}) !== 1'b1) begin\n"
        "          $display(\"FAIL: behind clock %0d {name} is %h, and not %h\", clock, {name}, "
        "expected_{name});\n          failed = 1;\n        end\n",
        {{"name", port.name}});
  }
  comparisons.pop_back();
  const std::string parameters = list(bench.parameters, ", ", [](const IpPorts::Parameter& p) {
    return "." + p.name + "(" + std::to_string(p.value) + ")";
  });
  return filled(
      verilog,
      {{"ip", bench.ip},
       {"columns", columns_text(bench)},
       {"clocks", list(bench.clocks, "\n",
                       [](const std::string& clock) { return "  logic " + clock + " = 0;"; })},
       {"raise", all_clocks + " = " + (several ? "rises" : "1")},
       {"lower", all_clocks + " = 0"},
       {"lines", std::to_string(bench.lines)},
       {"declarations", declarations},
       {"parameters", parameters.empty() ? "" : "#(" + parameters + ") "},
       {"connections", list(bench.clocks, ", ", connection) + ", " +
                           list(bench.inputs, ", ", port_connection) + ", " +
                           list(bench.outputs, ", ", port_connection)},
       {"input_formats", repeated(" %h", stimulus.size())},
       {"output_formats", repeated(" %h", bench.outputs.size())},
       {"inputs", list(stimulus, ", ", name_of)},
       {"expected",
        list(bench.outputs, ", ", [](const Port& port) { return "expected_" + port.name; })},
       {"input_count", std::to_string(stimulus.size())},
       {"output_count", std::to_string(bench.outputs.size())},
       {"comparisons", comparisons}});
}

constexpr const char* vhdl =
    R"(-- Made by markervp: plays stimulus.hex to {ip}, and compares it with response.hex. A line is a clock,
-- a column a port{columns}. What an output need not be is X there. VHDL-2008.
--   ghdl -a --std=08 YOUR_FILES bench.vhd && ghdl -e --std=08 bench && ghdl -r --std=08 bench
library ieee;
use ieee.std_logic_1164.all;
use std.textio.all;

entity bench is
end entity;

architecture test of bench is
  constant CLOCKS : positive := {lines};
  signal {clocks} : std_logic := '0';
{declarations}
begin
  dut : entity work.{ip}
{generics}    port map (
      {connections});

  process
    file stimulus : text open read_mode is "stimulus.hex";
    file response : text open read_mode is "response.hex";
    variable values : line;
    variable good   : boolean;
    variable failed : boolean := false;
{variables}
    procedure compare(name : string; is_now, expected : std_logic_vector; clock : positive) is
    begin
      if not is_x(expected) and is_now /= expected then
        report "FAIL: behind clock " & integer'image(clock) & " " & name & " is " & to_hstring(is_now)
          & ", and not " & to_hstring(expected) severity error;
        failed := true;
      end if;
    end procedure;
  begin
    for clock in 1 to CLOCKS loop
      assert not endfile(stimulus) and not endfile(response)
        report "FAIL: clock " & integer'image(clock) & " is not in stimulus.hex or response.hex" severity failure;
      readline(stimulus, values);
{reads}      readline(response, values);
{expected_reads}      wait for 5 ns;
      {raise}
      wait for 5 ns;
{comparisons}      assert not failed report "{ip} differs" severity failure;
      {lower}
    end loop;
    report "PASS: equal on " & integer'image(CLOCKS) & " clocks";
    wait;
  end process;
end architecture;
)";

std::string vhdl_bench(const Bench& bench) {
  const auto vector = [](const Port& port) {
    return "std_logic_vector(" + std::to_string(port.bits - 1) + " downto 0)";
  };
  // A single bit is no vector.
  const auto connection = [](const Port& port) {
    return port.name + " => " + port.name + (port.bits == 1 ? "(0)" : "");
  };
  const auto read = [](const std::string& variable, const std::string& file) {
    return "      hread(values, " + variable + ", good);\n      assert good report \"" + file +
           ": no number for " + variable + "\" severity failure;\n";
  };
  const auto clock_connection = [](const std::string& name) { return name + " => " + name; };
  std::string declarations, variables, reads, expected_reads, comparisons, raise, lower;
  for (const Port& port : bench.rises()) {
    variables += "    variable " + port.name + " : " + vector(port) + ";\n";
    reads += read(port.name, "stimulus.hex");
  }
  for (std::size_t i = 0; i < bench.clocks.size(); ++i) {
    const std::string bit = std::to_string(bench.clocks.size() - 1 - i);
    const std::string level = bench.rises().empty() ? "'1'" : "rises(" + bit + ")";
    raise += (i == 0 ? "" : " ") + bench.clocks[i] + " <= " + level + ";";
    lower += (i == 0 ? "" : " ") + bench.clocks[i] + " <= '0';";
  }
  for (const Port& port : bench.inputs) {
    declarations += "  signal " + port.name + " : " + vector(port) + ";\n";
    variables += "    variable next_" + port.name + " : " + vector(port) + ";\n";
    reads += read("next_" + port.name, "stimulus.hex") + "      " + port.name + " <= next_" +
             port.name + ";\n";
  }
  for (const Port& port : bench.outputs) {
    declarations += "  signal " + port.name + " : " + vector(port) + ";\n";
    variables += "    variable expected_" + port.name + " : " + vector(port) + ";\n";
    expected_reads += read("expected_" + port.name, "response.hex");
    comparisons += "      compare(\"" + port.name + "\", " + port.name + ", expected_" + port.name +
                   ", clock);\n";
  }
  const std::string generics = list(bench.parameters, ", ", [](const IpPorts::Parameter& p) {
    return p.name + " => " + std::to_string(p.value);
  });
  return filled(vhdl, {{"ip", bench.ip},
                       {"columns", columns_text(bench)},
                       {"clocks", list(bench.clocks, ", ", as_it_is)},
                       {"raise", raise},
                       {"lower", lower},
                       {"lines", std::to_string(bench.lines)},
                       {"declarations", declarations},
                       {"generics", generics.empty() ? "" : "    generic map (" + generics + ")\n"},
                       {"connections", list(bench.clocks, ", ", clock_connection) + ", " +
                                           list(bench.inputs, ", ", connection) + ", " +
                                           list(bench.outputs, ", ", connection)},
                       {"variables", variables},
                       {"reads", reads},
                       {"expected_reads", expected_reads},
                       {"comparisons", comparisons}});
}

}  // namespace

RtlVectors::RtlVectors(sc_core::sc_module_name name, const std::string& ip, IpPorts ports,
                       const std::string& folder)
    : PortWatcher(name, ports),
      ip_(ip),
      folder_(folder),
      ports_(std::move(ports)),
      stimulus_(folder + "/stimulus.hex"),
      response_(folder + "/response.hex") {
  const bool foreign_pins =
      !ports_.memory_outputs.empty() ||
      std::any_of(ports_.inputs.begin(), ports_.inputs.end(),
                  [](const IpPorts::Input& input) { return input.port == nullptr; });
  if (!foreign_pins && !ports_.combinational) return;
  throw vp::InputError("there are no vectors of " + ip + ": it has " +
                       (foreign_pins ? "pins that are no ports of its model"
                                     : "outputs that follow its inputs within the clock") +
                       "; use lock-step");
}

// Edges of several clocks at one time share a line.
void RtlVectors::edge_of(std::size_t clock) {
  const std::uint64_t now = this->clock().scheduler().now_ps();
  if (lines_ == 0 || now != line_ps_) {
    if (lines_ != 0) end_line();
    begin_line();
    line_ps_ = now;
  }
  rises_ |= 1u << (ports_.clocks.size() - 1 - clock);
}

// An edge samples the inputs; what the one before it made of its own is at the outputs.
void RtlVectors::begin_line() {
  was_reset_ = was_reset_ || in_reset();
  inputs_.clear();
  for (const IpPorts::Input& input : ports_.inputs) append_hex(inputs_, input.read(), input.bits);
  inputs_.back() = '\n';
  rises_ = 0;
  ++lines_;
}

// The system reset also resets what survives the other one.
bool RtlVectors::in_reset() const {
  const auto named = [this](const char* name) {
    return std::find_if(ports_.inputs.begin(), ports_.inputs.end(),
                        [name](const IpPorts::Input& input) { return input.name == name; });
  };
  auto reset = named("por");
  if (reset == ports_.inputs.end()) reset = named("rst");
  return reset == ports_.inputs.end() || reset->read() != 0;
}

void RtlVectors::end_line() {
  std::string line;
  if (ports_.clocks.size() > 1)
    append_hex(line, rises_, static_cast<unsigned>(ports_.clocks.size()));
  stimulus_.write(line + inputs_);
  line.clear();
  for (const IpPorts::Output& output : ports_.outputs) {
    if (output.optional) continue;
    if (was_reset_ && (!output.valid || output.valid())) {
      append_hex(line, output.port()->bits(), output.bits);
    } else {
      line.append((output.bits + 3) / 4, 'X') += ' ';
    }
  }
  line.back() = '\n';
  response_.write(line);
}

void RtlVectors::end_of_simulation() {
  if (lines_ != 0) end_line();
  Bench bench{ip_, {}, {}, {}, {}, lines_};
  for (const IpPorts::ClockPin& clock : ports_.clocks) bench.clocks.push_back(clock.name);
  std::copy_if(ports_.parameters.begin(), ports_.parameters.end(),
               std::back_inserter(bench.parameters),
               [](const IpPorts::Parameter& parameter) { return !parameter.usual; });
  for (const IpPorts::Input& input : ports_.inputs)
    bench.inputs.push_back({input.name, input.bits});
  for (const IpPorts::Output& output : ports_.outputs) {
    if (!output.optional) bench.outputs.push_back({output.name, output.bits});
  }
  stimulus_.commit();
  response_.commit();
  vp::write_file(folder_ + "/bench.sv", verilog_bench(bench));
  vp::write_file(folder_ + "/bench.vhd", vhdl_bench(bench));
}

}  // namespace pl
