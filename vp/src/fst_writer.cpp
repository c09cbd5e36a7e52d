#include "fst_writer.h"

#include <fstapi.h>
#include <vp/error.h>

#include <cerrno>
#include <cstring>
#include <limits>
#include <system_error>

namespace vp {

FstWriter::FstWriter(const std::filesystem::path& file)
    : file_(file),
      output_(std::in_place, file.string(), OutputFile::By::name),
      hierarchy_(std::in_place, output_->part() + ".hier") {
  errno = 0;
  context_ = fstWriterCreate(output_->part().c_str(), 1);
  if (!context_) throw OutputError(file_.string(), errno);
  // Nothing in the file that depends on the date.
  fstWriterSetDate(context_, "");
  fstWriterSetVersion(context_, "markervp");
  fstWriterSetTimescale(context_, -12);
  fstWriterSetPackType(context_, FST_WR_PT_LZ4);
}

FstWriter::~FstWriter() {
  if (!context_) return;
  finish();
  try {
    if (begun_) output_->commit();
  } catch (const OutputError&) {  // nothing is left, then
  }
}

FstWriter::Id FstWriter::add(std::string_view path, Kind kind, unsigned width) {
  if (begun_) throw std::logic_error("FstWriter::add() after begin()");
  declarations_.push_back(checked_declaration(path, kind, width));
  const unsigned bits = declarations_.back().width;
  variables_.push_back({0, 0, bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1});
  return static_cast<Id>(variables_.size() - 1);
}

void FstWriter::declare(const WaveScope& scope) {
  for (const auto& [leaf, id] : scope.variables) {
    const WaveDeclaration& d = declarations_[id];
    const bool is_text = d.kind == Kind::text;
    const auto type = d.kind == Kind::real  ? FST_VT_VCD_REAL
                      : is_text             ? FST_VT_GEN_STRING
                      : d.kind == Kind::reg ? FST_VT_VCD_REG
                                            : FST_VT_VCD_WIRE;
    std::string name = leaf;
    if (d.kind != Kind::real && d.width > 1) name += " [" + std::to_string(d.width - 1) + ":0]";
    const unsigned bytes = d.kind == Kind::real ? 8 : is_text ? 0 : d.width;
    variables_[id].handle =
        fstWriterCreateVar(context_, type, FST_VD_IMPLICIT, bytes, name.c_str(), 0);
  }
  for (const auto& child : scope.children) {
    fstWriterSetScope(context_, FST_ST_VCD_MODULE, child->name.c_str(), nullptr);
    declare(*child);
    fstWriterSetUpscope(context_);
  }
}

void FstWriter::begin(std::uint64_t ps, const std::vector<std::uint64_t>& values) {
  if (begun_ || values.size() != variables_.size()) {
    throw std::logic_error("FstWriter::begin() wants one value per variable, once");
  }
  declare(WaveScope::of(declarations_));
  begun_ = true;
  time_ps_ = ps;
  fstWriterEmitTimeChange(context_, ps);
  emit_all(values);
}

void FstWriter::set_time(std::uint64_t ps) {
  if (ps == time_ps_) return;
  time_ps_ = ps;
  fstWriterEmitTimeChange(context_, ps);
}

void FstWriter::emit(Id id) {
  const Variable& variable = variables_[id];
  const WaveDeclaration& declaration = declarations_[id];
  if (declaration.kind == Kind::real) {
    fstWriterEmitValueChange(context_, variable.handle, &variable.last);
    return;
  }
  digits_.assign(declaration.width, '0');
  std::uint64_t rest = variable.last;
  for (auto digit = digits_.rbegin(); rest != 0 && digit != digits_.rend(); ++digit, rest >>= 1) {
    *digit = static_cast<char>('0' + (rest & 1));
  }
  fstWriterEmitValueChange(context_, variable.handle, digits_.data());
}

void FstWriter::emit_all(const std::vector<std::uint64_t>& values) {
  for (Id id = 0; id < variables_.size(); ++id) {
    if (declarations_[id].kind == Kind::text) {
      change_text(id, {});
      continue;
    }
    variables_[id].last = values[id] & variables_[id].mask;
    emit(id);
  }
}

void FstWriter::change(Id id, std::uint64_t bits) {
  Variable& variable = variables_[id];
  bits &= variable.mask;
  if (bits == variable.last) return;
  variable.last = bits;
  emit(id);
}

// As a VCD says it: what is left out on the left is 0, or the leftmost digit if that is x or z.
void FstWriter::change_digits(Id id, std::string_view digits) {
  const WaveDeclaration& declaration = declarations_[id];
  if (declaration.kind == Kind::real) {
    double value = std::numeric_limits<double>::quiet_NaN();
    try {
      value = std::stod(std::string(digits));
    } catch (const std::exception&) {  // "nan" and what else is no number: not known
    }
    fstWriterEmitValueChange(context_, variables_[id].handle, &value);
    return;
  }
  const bool unknown = !digits.empty() && digits.front() != '0' && digits.front() != '1';
  digits_.assign(declaration.width, unknown ? digits.front() : '0');
  const std::size_t count = std::min<std::size_t>(digits.size(), declaration.width);
  digits_.replace(declaration.width - count, count, digits.substr(digits.size() - count));
  fstWriterEmitValueChange(context_, variables_[id].handle, digits_.data());
}

void FstWriter::change_text(Id id, std::string_view text) {
  fstWriterEmitVariableLengthValueChange(context_, variables_[id].handle, text.data(),
                                         static_cast<std::uint32_t>(text.size()));
}

void FstWriter::pause() {
  for (Id id = 0; id < variables_.size(); ++id) {
    if (declarations_[id].kind == Kind::text) {
      change_text(id, {});
    } else {
      change_digits(id, declarations_[id].kind == Kind::real ? "nan" : "x");
    }
  }
}

void FstWriter::resume(const std::vector<std::uint64_t>& values) {
  emit_all(values);
}

void FstWriter::finish() {
  fstWriterClose(context_);
  context_ = nullptr;
}

void FstWriter::close(std::uint64_t end_ps) {
  if (!context_) return;
  if (begun_) set_time(end_ps);
  finish();
  if (begun_) {
    // fstapi tells nothing of failed writes: a file that it can open again is whole.
    void* reader = fstReaderOpen(output_->part().c_str());
    const bool whole = reader && fstReaderGetEndTime(reader) == end_ps;
    if (reader) fstReaderClose(reader);
    if (!whole) {
      throw OutputError("cannot write '" + file_.string() +
                        "': not everything could be written; make room, or write less");
    }
    output_->commit();
  }
  output_.reset();
}

}  // namespace vp
