#include <xilinx/blk_mem_gen/blk_mem_gen.h>

#include <algorithm>
#include <string>

#include <vp/error.h>
#include <vp/report.h>
#include <vp/text.h>
#include <xilinx/axi_bram_ctrl/axi_bram_ctrl.h>
#include <xilinx/bram/bram.h>
#include <xilinx/common/axi_lite_ip.h>

namespace xilinx {

namespace {

constexpr std::uint32_t bits_of_byte = 8, most_port_bits = 64;

std::uint64_t bits(unsigned count) {
  return count >= most_port_bits ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1;
}

std::uint64_t bytes_of_word(std::uint32_t width) {
  return (width + bits_of_byte - 1) / bits_of_byte;
}

}  // namespace

BlkMemGen::BlkMemGen(sc_core::sc_module_name name, const std::vector<vp::Clock*>& clocks,
                     const BlkMemGenBuild& build)
    : sc_module(name), Ip(clocks.at(0)), build_(build) {
  const std::string own = this->name();
  std::uint64_t size = build.words * bytes_of_word(build.word_bits);
  for (const BlkMemPortBuild& port : build.ports) {
    if (port.width < 1 || port.width > most_port_bits)
      throw vp::InputError(own + ": a port of " + std::to_string(port.width) +
                           " bits is not modelled, those of 1 to 64 are");
    const bool fits =
        port.width == build.ports.front().width ||
        (port.width % bits_of_byte == 0 && build.ports.front().width % bits_of_byte == 0);
    if (!fits)
      throw vp::InputError(own + ": ports of different widths are modelled in whole bytes");
    size = std::max(size, port.depth * bytes_of_word(port.width));
    is_written_ = is_written_ || port.writes;
  }
  own_.assign(size, 0);
  for (std::size_t i = 0; i < build.contents.size(); ++i)
    write(i * bytes_of_word(build.word_bits), build.word_bits, build.contents[i]);
  for (std::size_t i = 0; i < build.ports.size(); ++i)
    ports_.emplace_back(("port_" + std::string(1, static_cast<char>('a' + i))).c_str(),
                        *clocks.at(i), *this, build.ports[i]);
}

void BlkMemGen::share(AxiBramCtrl& controller) {
  if (controller_) return controller.share(*controller_);
  controller.extend(own_.size());
  std::copy(own_.begin(), own_.end(), controller.contents().begin());
  controller_ = &controller;
  bytes_ = &controller.contents();
}

std::uint64_t BlkMemGen::read(std::uint64_t address, std::uint32_t width) const {
  const std::uint64_t count = bytes_of_word(width);
  if (address >= bytes_->size() || bytes_->size() - address < count) return 0;
  std::uint64_t word = 0;
  for (std::uint64_t i = 0; i < count; ++i)
    word |= std::uint64_t{(*bytes_)[address + i]} << bits_of_byte * i;
  return word & bits(width);
}

void BlkMemGen::write(std::uint64_t address, std::uint32_t width, std::uint64_t word) {
  const std::uint64_t count = bytes_of_word(width);
  if (address >= bytes_->size() || bytes_->size() - address < count) {
    if (!warned_)
      vp::warn(*this, "/markervp/blk_mem_gen/range",
               "a write to byte " + vp::hex(address) + " of " + std::to_string(bytes_->size()) +
                   " is lost: the address is not in the memory");
    warned_ = true;
    return;
  }
  for (std::uint64_t i = 0; i < count; ++i)
    (*bytes_)[address + i] = static_cast<unsigned char>(word >> bits_of_byte * i);
}

vp::IpEstimate BlkMemGen::own_estimate() const {
  double blocks = build_.bram36;
  if (blocks == 0 && !build_.ports.empty())
    blocks = block_ram_36(build_.ports.front().depth, build_.ports.front().width);
  vp::IpEstimate e = axi_estimate("blk_mem_gen", 0, 0, blocks);
  e.source = build_.bram36 != 0 ? "as Vivado counts its blocks" : "UG473 table 1-7";
  e.active_clocks = [this] {
    std::uint64_t sum = 0;
    for (const Port& port : ports_) sum += port.accesses.get();
    return sum;
  };
  return e;
}

BlkMemGen::Port::Port(sc_core::sc_module_name name, vp::Clock& clock, BlkMemGen& memory,
                      const BlkMemPortBuild& build)
    : Clocked(name, clock),
      dout("dout", build.width),
      memory_(memory),
      build_(build),
      stages_(std::max(build.latency, 1u), 0) {}

void BlkMemGen::Port::before_end_of_elaboration() {
  Clocked::before_end_of_elaboration();
  for (vp::In<bool>* pin : {&en, &rst, &regce})
    if (pin->bound()) pin->signal()->attach(*this);
  for (vp::In<std::uint64_t>* pin : {&we, &addr, &din})
    if (pin->bound()) pin->signal()->attach(*this);
}

void BlkMemGen::Port::on_change(vp::SignalBase& signal, std::uint32_t id) {
  quiet_ = 0;
  Clocked::on_change(signal, id);
  wake();
}

bool BlkMemGen::Port::enabled() const {
  return en.bound() ? en.read() : !build_.has_enable;
}

std::uint64_t BlkMemGen::Port::written(std::uint64_t old) const {
  const std::uint64_t word = din.bound() ? din.read() : 0, enables = we.bound() ? we.read() : 0;
  if (build_.lane_bits == 0) return (enables & 1) != 0 ? word : old;
  std::uint64_t mask = 0;
  for (unsigned lane = 0; lane * build_.lane_bits < build_.width; ++lane)
    if ((enables >> lane & 1) != 0) mask |= bits(build_.lane_bits) << lane * build_.lane_bits;
  return (old & ~mask) | (word & mask);
}

void BlkMemGen::Port::access() {
  using WriteMode = BlkMemPortBuild::WriteMode;
  ++accesses;
  const std::uint64_t said = addr.bound() ? addr.read() : 0, each = bytes_of_word(build_.width);
  std::uint64_t address = build_.byte_addresses ? said / each * each : said * each;
  // As a BRAM controller counts, the memory looks at the address bits that it needs.
  if (build_.byte_addresses) address %= memory_.bytes_->size();
  const std::uint64_t old = memory_.read(address, build_.width);
  const bool is_write = build_.writes && we.bound() && we.read() != 0;
  std::uint64_t now = old;
  if (is_write) {
    now = written(old) & bits(build_.width);
    memory_.write(address, build_.width, now);
  }
  if (!build_.reads || (is_write && build_.write_mode == WriteMode::no_change)) return;
  stages_.front() = is_write && build_.write_mode == WriteMode::write_first ? now : old;
}

void BlkMemGen::Port::edge() {
  const bool is_on = enabled(), passes = regce.bound() ? regce.read() : is_on;
  // The registers at the output take what was there before this edge.
  if (passes)
    for (std::size_t i = stages_.size() - 1; i > 0; --i) stages_[i] = stages_[i - 1];
  if (is_on) access();
  const bool in_reset = rst.bound() && rst.read();
  if (in_reset && (is_on || stages_.size() > 1)) stages_.back() = build_.reset_value;
  rst_busy = in_reset;
  dout = stages_.back();
  const bool may_change = is_on && memory_.changes();
  if (may_change || quiet_++ <= stages_.size()) return wake();
  sleep();
}

}  // namespace xilinx
