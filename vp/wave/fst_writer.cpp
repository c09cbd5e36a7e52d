#include <lz4.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/varint.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "fst_format.h"
#include "wave_input.h"

namespace vp {

namespace {

/// Bytes of changes that make a block: what a reader has to hold at a time. With 16 MiB files are 3
/// % smaller, and reading takes twice the memory and a third more time (measured).
constexpr std::size_t block_size = 4 << 20;
/// Shorter chains are not worth packing.
constexpr std::size_t shortest_packed = 32;

/// `bytes` through zlib where that is shorter; both lengths being equal says that it was not.
std::string deflated(const std::string& bytes, int level) {
  uLongf size = compressBound(bytes.size());
  std::string packed(size, '\0');
  const int result = compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                               reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), level);
  if (result != Z_OK || size >= bytes.size()) return bytes;
  packed.resize(size);
  return packed;
}

/// In the byte order of this machine; the header says which that is.
std::string bytes_of(double real) {
  std::string bytes(sizeof real, '\0');
  std::memcpy(bytes.data(), &real, sizeof real);
  return bytes;
}

class FstWriter final : public WaveWriter {
 public:
  explicit FstWriter(const std::filesystem::path& file) : output_(file.string()) {}
  /// Without close(): keeps what was written, or nothing if there is no value in it yet.
  ~FstWriter() override;
  FstWriter(const FstWriter&) = delete;
  FstWriter& operator=(const FstWriter&) = delete;

  Id add(std::string_view path, Kind kind, unsigned width) override;
  void begin(std::uint64_t ps, const std::vector<std::uint64_t>& values) override;
  void begin_written(std::uint64_t ps, const WrittenValues& values) override;
  bool begun() const override { return begun_; }
  void set_time(std::uint64_t ps) override;
  void change(Id id, std::uint64_t bits) override;
  void change_digits(Id id, std::string_view digits) override;
  void change_text(Id id, std::string_view text) override;
  void pause() override;
  void resume(const std::vector<std::uint64_t>& values) override { emit_all(values); }
  bool failed() const override { return output_.failed(); }
  void close(std::uint64_t end_ps) override;

 private:
  struct Variable {
    Kind kind;
    std::uint32_t width;
    bool in_digits = true;      ///< the value is `digits`, not `bits`
    std::uint32_t instant = 0;  ///< index of the time of its last change in this block
    std::uint64_t bits = 0;     ///< of a real its pattern
    std::uint64_t mask;
    std::string digits;
    std::string chain;  ///< the changes in this block
  };

  void start(std::uint64_t ps, std::size_t values);
  std::string header() const;
  void declare(const WaveScope& scope);
  void begin_block();
  void flush_block();
  std::string frame() const;
  void write_block(std::uint8_t type, const std::string& content);
  std::string chains(std::string& table, std::uint64_t& unpacked) const;
  /// The delta of a change, shifted to make room for `flag_bits`; counts the bytes.
  std::uint64_t delta(Variable& variable, unsigned flag_bits);
  void emit_bits(Variable& variable);
  void emit_digits(Variable& variable);
  void emit_all(const std::vector<std::uint64_t>& values);
  void finish();

  OutputFile output_;
  bool begun_ = false, closed_ = false;
  std::uint64_t first_ps_ = 0, time_ps_ = 0;
  std::uint64_t blocks_ = 0, scopes_ = 0;
  std::vector<WaveDeclaration> declarations_;
  std::vector<Variable> variables_;
  std::vector<Id> by_handle_;
  std::string hierarchy_;
  // The block that is being filled.
  std::uint64_t block_start_ps_ = 0;
  std::string frame_;  ///< all values as they were at its start
  std::string times_;
  std::uint32_t instants_ = 0;
  std::size_t pending_ = 0;  ///< bytes in the chains
};

FstWriter::~FstWriter() {
  if (closed_ || !begun_) return;
  try {
    finish();
  } catch (const OutputError&) {  // nothing is left, then
  }
}

FstWriter::Id FstWriter::add(std::string_view path, Kind kind, unsigned width) {
  if (begun_) throw std::logic_error("FstWriter::add() after begin()");
  declarations_.push_back(checked_declaration(path, kind, width));
  Variable variable{};
  variable.kind = kind;
  variable.width = declarations_.back().width;
  variable.mask =
      variable.width >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << variable.width) - 1;
  variable.in_digits = true;
  variables_.push_back(std::move(variable));
  return static_cast<Id>(variables_.size() - 1);
}

void FstWriter::start(std::uint64_t ps, std::size_t values) {
  if (begun_ || values != variables_.size()) {
    throw std::logic_error("FstWriter::begin() wants one value per variable, once");
  }
  declare(WaveScope::of(declarations_));
  begun_ = true;
  first_ps_ = time_ps_ = ps;
  for (Variable& variable : variables_) {
    variable.digits = variable.kind == Kind::real
                          ? bytes_of(std::numeric_limits<double>::quiet_NaN())
                          : std::string(variable.kind == Kind::text ? 0 : variable.width, 'x');
  }
  output_.write(header());
  begin_block();
}

void FstWriter::begin(std::uint64_t ps, const std::vector<std::uint64_t>& values) {
  start(ps, values.size());
  emit_all(values);
}

void FstWriter::begin_written(std::uint64_t ps, const WrittenValues& values) {
  start(ps, values.size());
  for (Id id = 0; id < values.size(); ++id) {
    if (!values[id]) continue;
    if (variables_[id].kind == Kind::text) {
      change_text(id, *values[id]);
    } else {
      change_digits(id, *values[id]);
    }
  }
}

void FstWriter::set_time(std::uint64_t ps) {
  if (ps == time_ps_) return;
  if (pending_ + times_.size() >= block_size) {
    flush_block();
    begin_block();
  }
  ++instants_;
  put_varint(times_, ps - time_ps_);
  time_ps_ = ps;
}

std::uint64_t FstWriter::delta(Variable& variable, unsigned flag_bits) {
  const std::uint64_t instants = instants_ - variable.instant;
  variable.instant = instants_;
  return instants << flag_bits;
}

void FstWriter::emit_bits(Variable& variable) {
  std::string& chain = variable.chain;
  const std::size_t before = chain.size();
  if (variable.kind == Kind::real) {
    put_varint(chain, delta(variable, 1) | 1);
    chain.append(reinterpret_cast<const char*>(&variable.bits), sizeof variable.bits);
  } else if (variable.width == 1) {
    put_varint(chain, delta(variable, 2) | variable.bits << 1);
  } else {
    put_varint(chain, delta(variable, 1));
    const unsigned bytes = (variable.width + 7) / 8;
    if (bytes > 8) {
      // The bits end somewhere in the last byte: those of the low 64 spread over nine.
      chain.append(bytes - 9, '\0');
      const unsigned unused = bytes * 8 - variable.width;
      const auto wide = static_cast<unsigned __int128>(variable.bits) << unused;
      for (int i = 8; i >= 0; --i) chain += static_cast<char>(wide >> (8 * i));
    } else {
      const std::uint64_t left_aligned = variable.bits << (64 - variable.width);
      for (unsigned i = 0; i < bytes; ++i) chain += static_cast<char>(left_aligned >> (56 - 8 * i));
    }
  }
  pending_ += chain.size() - before;
}

void FstWriter::emit_digits(Variable& variable) {
  std::string& chain = variable.chain;
  const std::size_t before = chain.size();
  if (variable.width == 1 && variable.kind != Kind::real) {
    const auto letter = std::min(fst::letters.find(variable.digits.front()), std::size_t{7});
    put_varint(chain, delta(variable, 4) | letter << 1 | 1);
  } else if (variable.digits.find_first_not_of("01") == std::string::npos) {
    put_varint(chain, delta(variable, 1));
    for (std::size_t at = 0; at < variable.digits.size(); at += 8) {
      std::uint8_t byte = 0;
      for (std::size_t i = at; i < std::min(at + 8, variable.digits.size()); ++i) {
        byte = static_cast<std::uint8_t>(byte | (variable.digits[i] & 1) << (7 - (i - at)));
      }
      chain += static_cast<char>(byte);
    }
  } else {
    put_varint(chain, delta(variable, 1) | 1);
    chain += variable.digits;
  }
  pending_ += chain.size() - before;
}

void FstWriter::emit_all(const std::vector<std::uint64_t>& values) {
  for (Id id = 0; id < variables_.size(); ++id) {
    Variable& variable = variables_[id];
    if (variable.kind == Kind::text) {
      change_text(id, {});
      continue;
    }
    variable.in_digits = false;
    variable.bits = values[id] & variable.mask;
    emit_bits(variable);
  }
}

void FstWriter::change(Id id, std::uint64_t bits) {
  Variable& variable = variables_[id];
  bits &= variable.mask;
  if (bits == variable.bits && !variable.in_digits) return;
  variable.in_digits = false;
  variable.bits = bits;
  emit_bits(variable);
}

// As a VCD says it: what is left out on the left is 0, or the leftmost digit if that is x or z.
void FstWriter::change_digits(Id id, std::string_view digits) {
  Variable& variable = variables_[id];
  if (const auto bits = bits_of_digits(digits, variable.kind == Kind::real)) {
    variable.in_digits = false;
    variable.bits = *bits & variable.mask;
    emit_bits(variable);
    return;
  }
  const auto is_binary = [](char c) { return c == '0' || c == '1'; };
  const char first = digits.front();
  variable.in_digits = true;
  variable.digits.assign(variable.width, is_binary(first) ? '0' : first);
  const std::size_t count = std::min<std::size_t>(digits.size(), variable.width);
  variable.digits.replace(variable.width - count, count, digits.substr(digits.size() - count));
  for (char& c : variable.digits) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  emit_digits(variable);
}

void FstWriter::change_text(Id id, std::string_view text) {
  Variable& variable = variables_[id];
  const std::size_t before = variable.chain.size();
  put_varint(variable.chain, delta(variable, 1));
  put_varint(variable.chain, text.size());
  variable.chain += text;
  pending_ += variable.chain.size() - before;
}

void FstWriter::pause() {
  for (Id id = 0; id < variables_.size(); ++id) {
    if (variables_[id].kind == Kind::text) {
      change_text(id, {});
    } else {
      change_digits(id, variables_[id].kind == Kind::real ? "nan" : "x");
    }
  }
}

std::string FstWriter::header() const {
  const char timescale = timescale_ps_ ? -12 : -15;
  constexpr double byte_order = 2.7182818284590452354;
  constexpr std::size_t version_size = 128, date_size = 119;
  std::string bytes(1, fst::header);
  fst::put_u64(bytes, fst::header_size - 1);
  fst::put_u64(bytes, first_ps_);
  fst::put_u64(bytes, time_ps_);
  bytes += bytes_of(byte_order);
  fst::put_u64(bytes, block_size);
  fst::put_u64(bytes, scopes_);
  fst::put_u64(bytes, variables_.size());
  fst::put_u64(bytes, variables_.size());
  fst::put_u64(bytes, blocks_);
  bytes += timescale;
  std::string version = "markervp";
  version.resize(version_size);
  // No date: the same changes give the same bytes.
  bytes += version + std::string(date_size, '\0');
  bytes += '\0';  // Verilog
  fst::put_u64(bytes, 0);
  return bytes;
}

void FstWriter::write_block(std::uint8_t type, const std::string& content) {
  std::string head(1, static_cast<char>(type));
  fst::put_u64(head, content.size() + 8);
  output_.write(head);
  output_.write(content);
}

std::string FstWriter::frame() const {
  std::string all;
  for (const Id id : by_handle_) {
    const Variable& variable = variables_[id];
    if (variable.kind == Kind::text) continue;
    if (variable.in_digits) {
      all += variable.digits;
    } else if (variable.kind == Kind::real) {
      all.append(reinterpret_cast<const char*>(&variable.bits), sizeof variable.bits);
    } else {
      const std::size_t end = all.size() + variable.width;
      all.resize(end, '0');
      std::uint64_t rest = variable.bits;
      for (std::size_t at = end; rest != 0; rest >>= 1)
        all[--at] = static_cast<char>('0' + (rest & 1));
    }
  }
  return all;
}

void FstWriter::begin_block() {
  block_start_ps_ = time_ps_;
  frame_ = frame();
  times_.clear();
  put_varint(times_, time_ps_);
  instants_ = 0;
  pending_ = 0;
  for (Variable& variable : variables_) {
    variable.chain.clear();
    variable.instant = 0;
  }
}

/// All chains, each once, and the table that says where each variable's begins.
std::string FstWriter::chains(std::string& table, std::uint64_t& unpacked) const {
  std::string bytes = "4";
  std::string packed;
  std::unordered_map<std::string_view, std::int64_t> first;  ///< by chain: minus the handle
  std::uint64_t without = 0, last_place = 0;
  std::int64_t last_alias = 0;
  for (std::size_t i = 0; i < by_handle_.size(); ++i) {
    const std::string& chain = variables_[by_handle_[i]].chain;
    if (chain.empty()) {
      ++without;
      continue;
    }
    if (without != 0) put_varint(table, std::exchange(without, 0) << 1);
    unpacked += chain.size();
    const auto [same, is_new] = first.emplace(chain, -static_cast<std::int64_t>(i + 1));
    if (!is_new) {
      const bool again = std::exchange(last_alias, same->second) == same->second;
      put_signed_varint(table, (again ? 0 : same->second) * 2 + 1);
      continue;
    }
    put_signed_varint(table, static_cast<std::int64_t>(bytes.size() - last_place) * 2 + 1);
    last_place = bytes.size();
    if (chain.size() > shortest_packed) {
      packed.resize(static_cast<std::size_t>(LZ4_compressBound(static_cast<int>(chain.size()))));
      const int size =
          LZ4_compress_default(chain.data(), packed.data(), static_cast<int>(chain.size()),
                               static_cast<int>(packed.size()));
      if (size > 0 && static_cast<std::size_t>(size) < chain.size()) {
        put_varint(bytes, chain.size());
        bytes.append(packed, 0, static_cast<std::size_t>(size));
        continue;
      }
    }
    bytes += '\0';
    bytes += chain;
  }
  if (without != 0) put_varint(table, without << 1);
  return bytes;
}

void FstWriter::flush_block() {
  constexpr int fast = 4;
  std::string table;
  std::uint64_t unpacked = 0;
  const std::string changes = chains(table, unpacked);
  const std::string packed_frame = deflated(frame_, fast), packed_times = deflated(times_, fast);

  std::string content;
  fst::put_u64(content, block_start_ps_);
  fst::put_u64(content, time_ps_);
  fst::put_u64(content, unpacked);
  put_varint(content, frame_.size());
  put_varint(content, packed_frame.size());
  put_varint(content, variables_.size());
  content += packed_frame;
  put_varint(content, variables_.size());
  content += changes;
  content += table;
  fst::put_u64(content, table.size());
  content += packed_times;
  fst::put_u64(content, times_.size());
  fst::put_u64(content, packed_times.size());
  fst::put_u64(content, std::uint64_t{instants_} + 1);
  write_block(fst::values_aliases_signed, content);
  ++blocks_;
}

/// Handles count in the order of the hierarchy.
void FstWriter::declare(const WaveScope& scope) {
  constexpr char module = 0, implicit = 0, no_alias = 0;
  std::string& to = hierarchy_;
  for (const auto& [leaf, id] : scope.variables) {
    const WaveDeclaration& d = declarations_[id];
    by_handle_.push_back(id);
    to += static_cast<char>(d.kind == Kind::real    ? fst::real
                            : d.kind == Kind::text  ? fst::text
                            : d.kind == Kind::reg   ? fst::reg
                            : d.kind == Kind::event ? fst::event
                                                    : fst::wire);
    to += implicit;
    to += leaf;
    if (d.kind != Kind::real && d.width > 1) to += " [" + std::to_string(d.width - 1) + ":0]";
    to += '\0';
    put_varint(to, d.kind == Kind::real ? sizeof(double) : d.kind == Kind::text ? 0 : d.width);
    to += no_alias;
  }
  for (const auto& child : scope.children) {
    ++scopes_;
    to += static_cast<char>(fst::scope);
    to += module;
    to += child->name + '\0' + '\0';
    declare(*child);
    to += static_cast<char>(fst::upscope);
  }
}

void FstWriter::finish() {
  closed_ = true;
  flush_block();
  std::string sizes;
  for (const Id id : by_handle_) {
    const Variable& variable = variables_[id];
    put_varint(sizes, variable.kind == Kind::real   ? 0
                      : variable.kind == Kind::text ? fst::variable_length
                                                    : variable.width);
  }
  std::string content;
  fst::put_u64(content, sizes.size());
  fst::put_u64(content, by_handle_.size());
  write_block(fst::geometry, content + deflated(sizes, 9));

  const auto most =
      static_cast<std::size_t>(LZ4_compressBound(static_cast<int>(hierarchy_.size())));
  std::string packed(most, '\0');
  packed.resize(static_cast<std::size_t>(LZ4_compress_default(hierarchy_.data(), packed.data(),
                                                              static_cast<int>(hierarchy_.size()),
                                                              static_cast<int>(most))));
  content.clear();
  fst::put_u64(content, hierarchy_.size());
  write_block(fst::hierarchy_lz4, content + packed);
  output_.overwrite(0, header());
  output_.commit();
}

void FstWriter::close(std::uint64_t end_ps) {
  if (closed_ || !begun_) return;
  set_time(end_ps);
  finish();
}

}  // namespace

std::unique_ptr<WaveWriter> open_fst_writer(const std::filesystem::path& file) {
  return std::make_unique<FstWriter>(file);
}

}  // namespace vp
