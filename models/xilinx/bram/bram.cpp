#include <xilinx/bram/bram.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

#include <vp/report.h>
#include <vp/text.h>

namespace xilinx {

namespace {

struct AspectRatio {
  std::uint64_t depth;
  std::uint32_t width;   ///< with the parity bits
  std::uint32_t powers;  ///< without
};

/// Of a block of 36 kbit (UG473 table 1-7); a block of 18 kbit is half as deep.
constexpr AspectRatio ratios[] = {{32768, 1, 1},  {16384, 2, 2},  {8192, 4, 4}, {4096, 9, 8},
                                  {2048, 18, 16}, {1024, 36, 32}, {512, 72, 64}};

double blocks_of(const AspectRatio& ratio, std::uint64_t depth, std::uint32_t width, bool parity) {
  const std::uint32_t each = parity ? ratio.width : ratio.powers;
  const std::uint64_t columns = (width + each - 1) / each;
  const std::uint64_t full_rows = depth / ratio.depth, rest = depth % ratio.depth;
  const double last_row = rest == 0 ? 0 : rest <= ratio.depth / 2 ? 0.5 : 1;
  return static_cast<double>(columns) * (static_cast<double>(full_rows) + last_row);
}

}  // namespace

double block_ram_36(std::uint64_t depth, std::uint32_t width, bool parity) {
  double fewest = std::numeric_limits<double>::max();
  for (const AspectRatio& ratio : ratios) {
    fewest = std::min(fewest, blocks_of(ratio, depth, width, parity));
  }
  return fewest;
}

namespace {

constexpr std::uint32_t largest_depth = 1u << 20;  // words: 4 MiB, more than any Zynq-7000 has

}  // namespace

Bram::Bram(sc_core::sc_module_name name, std::uint32_t default_depth_a)
    : sc_module(name),
      Ip(nullptr),
      depth_a("depth_a", default_depth_a, vp::Unit::none, {1, largest_depth}, vp::Source::published,
              "words of 32 bit at port A (thesis table 4.3)"),
      bytes_(std::size_t{depth_a} * word_bytes, 0) {}

// Exact: blocks of 36 kbit with a 32-bit port and an 8-bit port, which leaves the parity bits
// unused. The logic that chooses among the blocks is estimated. One block works at a time.
vp::IpEstimate Bram::own_estimate() const {
  vp::IpEstimate e;
  e.kind = "bram";
  e.bram36 = block_ram_36(depth_a, 32, false);
  e.lut = 20 + static_cast<std::uint32_t>(2 * e.bram36);
  e.ff = 20;
  e.source = "block memories computed from UG473's aspect ratios; logic between them assumed";
  e.uncertainty_percent = 0;
  e.fmax_hz = 100'000'000;
  e.fmax_high_hz = 388'200'000;
  e.fmax_origin = vp::FmaxOrigin::derived;
  e.fmax_documentation =
      "port A works at the thesis' system clock (table 4.3); a block memory's shortest period is "
      "2.576 "
      "ns in public timing reports of -1";
  e.memory_reads = [this] { return reads_b.get(); };
  return e;
}

void Bram::write_a(std::uint32_t address, std::uint32_t word) {
  write_a(address, &word, 1);
}

void Bram::write_a(std::uint32_t address, const std::uint32_t* words, std::uint32_t count) {
  const std::uint32_t fitting = address < depth_a ? std::min(count, depth_a - address) : 0;
  if (fitting != 0) store(address, words, fitting);
  for (std::uint32_t i = fitting; i < count; ++i) refuse_write(address + i);
}

void Bram::load(const std::vector<std::uint8_t>& bytes) {
  const auto count = static_cast<std::uint32_t>(std::min(bytes.size(), bytes_.size()));
  if (reader_) reader_->before_write(0, count);
  std::copy_n(bytes.begin(), count, bytes_.begin());
  if (reader_) reader_->after_write(0, count);
}

std::vector<std::uint8_t> Bram::fork() {
  std::vector<std::uint8_t> copy = bytes_;
  std::swap(copy, bytes_);
  return copy;
}

void Bram::store(std::uint32_t address, const std::uint32_t* words, std::uint32_t count) {
  const std::uint32_t first = address * word_bytes;
  if (reader_) {
    if (reader_->reads_now(first, count * word_bytes)) report_collision(address, count);
    reader_->before_write(first, count * word_bytes);
  }
  writes_a.add(count);
  std::memcpy(&bytes_[first], words, std::size_t{count} * word_bytes);
  if (reader_) reader_->after_write(first, count * word_bytes);
}

void Bram::report_collision(std::uint32_t address, std::uint32_t count) {
  reports_.violate(vp::Rule::bram_collision, nullptr,
                   "port B reads from word " + vp::hex(address) + " on, of which port A writes " +
                       std::to_string(count));
}

void Bram::refuse_write(std::uint32_t address) {
  ++out_of_range;
  reports_.violate(vp::Rule::bram_address, nullptr,
                   "write at word " + vp::hex(address) + ", the memory has " +
                       std::to_string(depth_a) + " words");
}

std::uint8_t Bram::refuse_read(std::uint32_t address) {
  ++out_of_range;
  reports_.violate(vp::Rule::bram_address, nullptr,
                   "read at byte " + vp::hex(address) + ", the memory has " +
                       std::to_string(bytes_.size()) + " bytes");
  return 0;
}

}  // namespace xilinx
