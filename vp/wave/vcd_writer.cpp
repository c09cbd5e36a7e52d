#include <vp/error.h>
#include <vp/text.h>
#include <vp/wave_writer.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>

#include "gzip_packer.h"
#include "wave_input.h"

namespace vp {

namespace {

/// One write to the system for so many bytes; stays in the second-level cache.
constexpr std::size_t buffer_size = 256 * 1024;
/// Longest line of a change: "b", 64 digits, suffix, written in steps of 8 bytes.
constexpr std::size_t longest_line = 96;

bool is_packed_vcd(const std::filesystem::path& file) {
  return file.extension() == ".gz" && file.stem().extension() == ".vcd";
}

/// Identifier codes use the 94 printable characters, the shortest first.
std::string identifier_code(VcdWriter::Id id) {
  std::string code;
  for (std::uint64_t rest = id + std::uint64_t{1}; rest > 0; rest = (rest - 1) / 94) {
    code += static_cast<char>('!' + (rest - 1) % 94);
  }
  return code;
}

}  // namespace

std::optional<std::uint64_t> bits_of_digits(std::string_view digits, bool is_real) {
  std::uint64_t bits = 0;
  if (is_real) {
    double value = std::numeric_limits<double>::quiet_NaN();
    std::from_chars(digits.data(), digits.data() + digits.size(), value);
    std::memcpy(&bits, &value, sizeof value);
    return bits;
  }
  if (digits.size() > 64) return std::nullopt;
  for (const char c : digits) {
    if (c != '0' && c != '1') return std::nullopt;
    bits = bits << 1 | (c & 1);
  }
  return bits;
}

VcdWriter::VcdWriter(const std::filesystem::path& file)
    : file_(std::make_unique<OutputFile>(file.string())), buffer_(buffer_size + longest_line) {
  cursor_ = buffer_.data();
  limit_ = cursor_ + buffer_size;
  if (is_packed_vcd(file)) packer_ = std::make_unique<GzipPacker>();
}

VcdWriter::~VcdWriter() {
  if (!file_ || !begun_) return;
  write_text("$comment incomplete: the run ended before its trace was closed $end\n");
  try {
    finish();
  } catch (const OutputError&) {  // nothing is left, then
  }
}

VcdWriter::Id VcdWriter::add(std::string_view path, Kind kind, unsigned width) {
  if (begun_) throw std::logic_error("VcdWriter::add() after begin()");
  const WaveDeclaration declaration = checked_declaration(path, kind, width);
  width = declaration.width;
  const Id id = static_cast<Id>(variables_.size());
  Variable variable{};
  variable.in_digits = true;
  variable.mask = width >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << width) - 1;
  variable.real = kind == Kind::real;
  variable.text = kind == Kind::text;
  variable.scalar = width == 1 && !variable.text;
  const std::string suffix = (variable.scalar ? "" : " ") + identifier_code(id) + "\n";
  variable.suffix_length = static_cast<std::uint8_t>(suffix.size());
  std::memcpy(variable.suffix, suffix.data(), suffix.size());
  variables_.push_back(variable);
  declarations_.push_back({std::string(path), kind, width});
  return id;
}

void VcdWriter::begin_dump(std::uint64_t ps, std::size_t values) {
  if (begun_ || values != variables_.size()) {
    throw std::logic_error("VcdWriter::begin() wants one value per variable, once");
  }
  write_header();
  begun_ = true;
  time_ps_ = ps;
  write_stamp();
  write_text("$dumpvars\n");
}

void VcdWriter::begin(std::uint64_t ps, const std::vector<std::uint64_t>& values) {
  begin_dump(ps, values.size());
  write_all(values);
  write_text("$end\n");
}

void VcdWriter::begin_written(std::uint64_t ps, const WrittenValues& values) {
  begin_dump(ps, values.size());
  for (Id id = 0; id < values.size(); ++id) {
    if (!values[id]) continue;
    if (variables_[id].text) {
      change_text(id, *values[id]);
    } else {
      change_digits(id, *values[id]);
    }
  }
  write_text("$end\n");
}

void VcdWriter::close(std::uint64_t end_ps) {
  if (!file_) return;
  if (begun_) {
    set_time(end_ps);
    if (stamp_due_) write_stamp();
    finish();
  }
  file_.reset();
}

void VcdWriter::write_all(const std::vector<std::uint64_t>& values) {
  for (std::size_t id = 0; id < variables_.size(); ++id) {
    if (variables_[id].text) {
      change_text(static_cast<Id>(id), {});
      continue;
    }
    variables_[id].last = values[id] & variables_[id].mask;
    variables_[id].in_digits = false;
    write_value(variables_[id]);
  }
}

void VcdWriter::pause() {
  if (stamp_due_) write_stamp();
  write_text("$dumpoff\n");
  for (std::size_t id = 0; id < variables_.size(); ++id) {
    Variable& variable = variables_[id];
    variable.in_digits = true;
    if (variable.text) {
      change_text(static_cast<Id>(id), {});
    } else {
      const char* value = variable.scalar ? "x" : variable.real ? "rnan" : "bx";
      write_text(value);
      write_text({variable.suffix, variable.suffix_length});
    }
  }
  write_text("$end\n");
}

void VcdWriter::resume(const std::vector<std::uint64_t>& values) {
  if (stamp_due_) write_stamp();
  write_text("$dumpon\n");
  write_all(values);
  write_text("$end\n");
}

void VcdWriter::change_digits(Id id, std::string_view digits) {
  if (stamp_due_) write_stamp();
  Variable& variable = variables_[id];
  const std::optional<std::uint64_t> bits = bits_of_digits(digits, variable.real);
  variable.in_digits = !bits;
  variable.last = bits.value_or(0) & variable.mask;
  if (!variable.scalar) write_text(variable.real ? "r" : "b");
  const auto is_capital = [](char c) { return c >= 'A' && c <= 'Z'; };
  if (std::any_of(digits.begin(), digits.end(), is_capital)) {
    std::string small(digits);
    for (char& c : small) c = static_cast<char>(is_capital(c) ? c - 'A' + 'a' : c);
    write_text(small);
  } else {
    write_text(digits);
  }
  write_text({variable.suffix, variable.suffix_length});
}

void VcdWriter::change_text(Id id, std::string_view text) {
  if (stamp_due_) write_stamp();
  std::string line = "s";
  for (const char c : text) {
    if (c > ' ' && c <= '~' && c != '\\') {
      line += c;
    } else {
      const auto byte = static_cast<unsigned char>(c);
      line += '\\';
      for (const int shift : {6, 3, 0}) line += static_cast<char>('0' + (byte >> shift & 7));
    }
  }
  write_text(line);
  write_text({variables_[id].suffix, variables_[id].suffix_length});
}

void VcdWriter::write_header() {
  write_text("$version markervp $end\n$timescale 1");
  write_text(timescale_ps_ ? "ps $end\n" : "fs $end\n");
  write_scope(WaveScope::of(declarations_));
  write_text("$enddefinitions $end\n");
}

void VcdWriter::write_scope(const WaveScope& scope) {
  for (const auto& [leaf, id] : scope.variables) write_declaration(id, leaf);
  for (const auto& child : scope.children) {
    write_text("$scope module " + child->name + " $end\n");
    write_scope(*child);
    write_text("$upscope $end\n");
  }
}

void VcdWriter::write_declaration(Id id, std::string_view leaf) {
  static constexpr const char* words[] = {"wire", "reg", "real", "string", "event"};
  const WaveDeclaration& declaration = declarations_[id];
  std::string line = "$var " + std::string(words[static_cast<int>(declaration.kind)]) + " " +
                     std::to_string(declaration.width) + " " + identifier_code(id) + " ";
  line += leaf;
  if (declaration.kind != Kind::real && declaration.width > 1) {
    line += " [" + std::to_string(declaration.width - 1) + ":0]";
  }
  write_text(line + " $end\n");
}

void VcdWriter::write_stamp() {
  stamp_due_ = false;
  if (cursor_ >= limit_) flush();
  *cursor_++ = '#';
  cursor_ = std::to_chars(cursor_, cursor_ + 20, time_ps_).ptr;
  *cursor_++ = '\n';
}

void VcdWriter::write_number(const Variable& variable) {
  char* at = cursor_;
  if (variable.real) {
    double value = 0;
    std::memcpy(&value, &variable.last, sizeof value);
    *at++ = 'r';
    at = std::to_chars(at, at + 32, value).ptr;
  } else {
    // Leading zeros are left out (IEEE 1364, 18.2.1). Eight digits a step, the first two without a
    // branch that would be mispredicted; what is too many is written over.
    const int digits = 64 - __builtin_clzll(variable.last | 1);
    std::uint64_t left_aligned = variable.last << (64 - digits);
    *at++ = 'b';
    std::memcpy(at, digits_of_byte[left_aligned >> 56].data(), 8);
    std::memcpy(at + 8, digits_of_byte[left_aligned >> 48 & 0xff].data(), 8);
    for (int done = 16; done < digits; done += 8) {
      left_aligned <<= 8;
      std::memcpy(at + done, digits_of_byte[left_aligned >> 48 & 0xff].data(), 8);
    }
    at += digits;
  }
  write_suffix(variable, at);
}

void VcdWriter::write_text(std::string_view text) {
  while (!text.empty()) {
    if (cursor_ >= limit_) flush();
    const std::size_t part = std::min(text.size(), static_cast<std::size_t>(limit_ - cursor_));
    std::memcpy(cursor_, text.data(), part);
    cursor_ += part;
    text.remove_prefix(part);
  }
}

void VcdWriter::flush() {
  const std::string_view bytes(buffer_.data(), static_cast<std::size_t>(cursor_ - buffer_.data()));
  file_->write(packer_ ? packer_->pack(bytes) : bytes);
  cursor_ = buffer_.data();
}

void VcdWriter::finish() {
  flush();
  if (packer_) file_->write(packer_->finish());
  const std::unique_ptr<OutputFile> file = std::move(file_);
  file->commit();
}

std::unique_ptr<WaveWriter> open_wave_writer(const std::filesystem::path& file) {
  std::error_code ignored;
  const bool is_device = std::filesystem::exists(file, ignored) &&
                         !std::filesystem::is_regular_file(file, ignored) &&
                         !std::filesystem::is_directory(file, ignored);
  if (!is_device && !is_wave_file_name(file)) {
    throw InputError("trace '" + file.string() + "': its name must end in .vcd, .vcd.gz or .fst");
  }
  if (!is_device && file.extension() == ".fst") return open_fst_writer(file);
  return std::make_unique<VcdWriter>(file);
}

bool is_wave_file_name(const std::filesystem::path& file) {
  return file.extension() == ".vcd" || file.extension() == ".fst" || is_packed_vcd(file);
}

}  // namespace vp
