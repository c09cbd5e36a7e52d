#include <chip/fault/fault_space.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include <vp/axi_stream.h>
#include <vp/error.h>
#include <vp/ip.h>
#include <vp/mm_link.h>
#include <vp/probe.h>
#include <vp/register_bank.h>
#include <vp/text.h>
#include <vp/unit.h>
#include <xilinx/bram/bram.h>

namespace platform {

namespace {

bool is_below(const std::string& path, const std::string& module) {
  return path.compare(0, module.size(), module) == 0 &&
         (path.size() == module.size() || path[module.size()] == '.');
}

std::string parent(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string::npos ? path : path.substr(0, dot);
}

std::string flip_text(const std::string& place, std::uint64_t bit) {
  return "what: flip, " + place + ", bit: " + std::to_string(bit);
}

}  // namespace

const std::vector<std::string>& FaultSpace::classes() {
  static const std::vector<std::string> names = {
      "bus", "register", "memory", "buffer", "internal", "signal", "stream", "clock", "input"};
  return names;
}

FaultSpace::FaultSpace(Injector& injector, const std::vector<std::string>& chosen,
                       const std::vector<std::string>& below, std::uint64_t units)
    : injector_(injector), below_(below) {
  for (const std::string& name : chosen.empty() ? classes() : chosen) {
    if (chosen.empty() && name == on_request) continue;
    Class found = find(name, injector, units);
    if (found.faults > 0) {
      classes_.push_back(std::move(found));
    } else if (!chosen.empty()) {
      throw vp::InputError("the design has no place for faults of class '" + name + "'" +
                           (below.empty() ? "" : " below " + vp::one_of(below)) +
                           ": leave it out of 'classes'");
    }
  }
  if (classes_.empty())
    throw vp::InputError("nothing is below " + vp::one_of(below) +
                         ": name modules of 'markervp map'");
}

void FaultSpace::add(Class& to, const std::string& path, std::uint64_t faults,
                     std::function<std::string(std::uint64_t)> text) const {
  const bool wanted = below_.empty() ||
                      std::any_of(below_.begin(), below_.end(), [&path](const std::string& module) {
                        return is_below(path, module);
                      });
  if (!wanted || faults == 0) return;
  to.places.push_back({parent(path), faults, std::move(text)});
  to.faults += faults;
}

FaultSpace::Class FaultSpace::find(const std::string& name, Injector& injector,
                                   std::uint64_t units) const {
  Zynq& zynq = injector.zynq();
  Class found{name, {}};
  if (name == "bus") find_on_buses(found);
  if (name == "register") find_registers(found, zynq);
  if (name == "memory") find_memories(found, zynq);
  if (name == "buffer") find_buffers(found, zynq);
  if (name == "internal") find_internals(found, injector);
  if (name == "signal") find_signals(found, injector);
  if (name == "stream") find_streams(found, zynq);
  if (name == "clock") find_clocks(found, zynq);
  if (name == "input") find_inputs(found, zynq, units);
  return found;
}

void FaultSpace::find_on_buses(Class& found) const {
  for (const vp::MmLink* link : vp::all_objects<vp::MmLink>()) {
    if (link->reads.get() + link->writes.get() == 0) continue;
    const std::string where = std::string("where: ") + link->name();
    add(found, link->name(), 2 + word_bits, [where](std::uint64_t n) {
      if (n < 2) return (n == 0 ? "what: slverr, " : "what: decerr, ") + where;
      return "what: corrupt, " + where + ", bit: " + std::to_string(n - 2);
    });
  }
}

void FaultSpace::find_registers(Class& found, Zynq& zynq) const {
  for (vp::RegisterBank* bank : vp::all_below<vp::RegisterBank>(zynq.pl())) {
    for (const vp::Register& one : bank->registers()) {
      if (one.removed()) continue;
      const std::string path = std::string(bank->name()) + "." + one.info().name;
      add(found, path, word_bits,
          [path](std::uint64_t n) { return flip_text("where: " + path, n); });
    }
  }
}

void FaultSpace::find_memories(Class& found, Zynq& zynq) const {
  for (const xilinx::Bram* memory : vp::all_below<xilinx::Bram>(zynq.pl())) {
    const std::string path = memory->name();
    add(found, path, std::uint64_t{8} * memory->size_b(), [path](std::uint64_t n) {
      return flip_text("where: " + path + ", address: " + std::to_string(n / 8), n % 8);
    });
  }
}

void FaultSpace::find_buffers(Class& found, Zynq& zynq) const {
  const ps::DmaAllocator& memory = zynq.ps.ddr.dma_memory();
  const std::uint64_t first = memory.first();
  add(found, std::string(zynq.ps.ddr.name()) + ".dma_memory", 8 * (memory.used() / 4 * 4),
      [first](std::uint64_t n) {
        return flip_text("address: " + vp::hex(first + n / word_bits * 4), n % word_bits);
      });
}

void FaultSpace::find_internals(Class& found, Injector& injector) const {
  for (const vp::ProbeBase* probe : vp::all_below<vp::ProbeBase>(injector.zynq().pl())) {
    const std::string path = probe->name();
    if (!probe->address() || !injector.unplayed(path).empty()) continue;
    add(found, path, probe->width(),
        [path](std::uint64_t n) { return flip_text("where: " + path, n); });
  }
}

void FaultSpace::find_signals(Class& found, Injector& injector) const {
  for (const vp::SignalBase* signal : vp::all_below<vp::SignalBase>(injector.zynq().pl())) {
    const std::string path = signal->name();
    const bool of_stream =
        dynamic_cast<const vp::AxiStream*>(signal->get_parent_object()) != nullptr;
    const bool moves = !of_stream && injector.unplayed(path).empty();
    if (!signal->can_be_forced() || signal->width() != 1 || !moves) continue;
    add(found, path, 5, [where = "where: " + path](std::uint64_t n) {
      if (n < 2) return "what: stuck, " + where + ", value: " + std::to_string(n) + ", for: 100 us";
      if (n == 2) return "what: lost, " + where;
      if (n == 3) return "what: late, " + where + ", by: 10 us";
      return "what: spurious, " + where + ", for: 1 us";
    });
  }
}

void FaultSpace::find_streams(Class& found, Zynq& zynq) const {
  for (const vp::AxiStream* stream : vp::all_below<vp::AxiStream>(zynq.pl())) {
    if (stream->beats.get() == 0 || !counts_beats(*stream)) continue;
    add(found, stream->name(), 3 + word_bits,
        [where = std::string("where: ") + stream->name()](std::uint64_t n) {
          constexpr const char* kinds[] = {"what: dropped, ", "what: repeated, ", "what: tlast, "};
          if (n < std::size(kinds)) return kinds[n] + where;
          return "what: corrupt, " + where + ", bit: " + std::to_string(n - std::size(kinds));
        });
  }
}

void FaultSpace::find_clocks(Class& found, Zynq& zynq) const {
  for (const auto& [number, source] : zynq.ps.fclks()) {
    const std::string path = source->clk.name();
    if (source->clk.edges_run() == 0) continue;
    const std::uint64_t half_hz = source->clk.frequency_hz() / 2;
    add(found, path, 2, [path, half_hz](std::uint64_t n) {
      return "what: clock, where: " + path +
             ", frequency: " + std::to_string(n == 0 ? 0 : half_hz) + " Hz";
    });
  }
}

void FaultSpace::find_inputs(Class& found, Zynq& zynq, std::uint64_t units) const {
  const std::uint64_t bytes = zynq.design().input().bytes;
  if (bytes == 0 || units == 0) return;
  // Of more than one, the first is right: a torn one shows what came before.
  const std::uint64_t first = std::min<std::uint64_t>(units, 2);
  const std::uint64_t count = units - first + 1;
  add(found, "input.unit", 5 * bytes, [first, count](std::uint64_t n) {
    const std::string unit = ", unit: " + std::to_string(first + n % count);
    const std::string from = ", from: " + std::to_string(n / 5);
    const std::string value = n % 2 == 0 ? "value: 0" : "value: 255";
    switch (n % 5) {
      case 0:
      case 1:
        return "what: input, " + value + from + ", bytes: 1" + unit + ", count: all";
      case 2:
      case 3:
        return "what: input, " + value + unit;
      default:
        return "what: torn" + from + unit;
    }
  });
}

FaultSpace::Drawn FaultSpace::draw(vp::RandomBits& random, std::uint64_t from_ps,
                                   std::uint64_t to_ps) const {
  const Class& drawn = classes_[random.next() % classes_.size()];
  std::uint64_t n = random.next() % drawn.faults;
  auto place = drawn.places.begin();
  for (; n >= place->faults; ++place) n -= place->faults;
  const std::uint64_t at_ps = from_ps + random.next() % std::max<std::uint64_t>(1, to_ps - from_ps);
  std::string text = place->text(n);
  if (drawn.name != "input") text += ", at: " + std::to_string(at_ps) + " ps";
  Drawn result{parse_faults("[{" + text + "}]", "campaign").front(), drawn.name, place->module};
  if (drawn.name == "input") result.fault.at_ps = injector_.before_unit_ps(result.fault.nth);
  return result;
}

}  // namespace platform
