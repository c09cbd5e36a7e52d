#include <fcntl.h>
#include <fstapi.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vp/error.h>
#include <vp/file.h>

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "wave_input.h"

namespace vp {

namespace {

[[noreturn]] void corrupt(const std::filesystem::path& file, const std::string& problem) {
  throw InputError("trace '" + file.string() + "': " + problem);
}

/// Every block says its length: the chain of them must end where the file ends.
void check_blocks(const std::filesystem::path& file) {
  constexpr unsigned last_block_type = 8, packed_type = 254, skipped_type = 255;
  const std::uint64_t size = std::filesystem::file_size(file);
  std::ifstream stream(file, std::ios::binary);
  for (std::uint64_t at = 0; at < size;) {
    unsigned char head[9] = {};
    stream.seekg(static_cast<std::streamoff>(at));
    stream.read(reinterpret_cast<char*>(head), sizeof head);
    const std::string place = " at byte " + std::to_string(at);
    if (!stream) corrupt(file, "truncated in the block" + place);
    if (head[0] > last_block_type && head[0] != packed_type && head[0] != skipped_type) {
      corrupt(file, "no FST block" + place + ": the file is corrupt, or no FST");
    }
    std::uint64_t length = 0;
    for (int i = 1; i < 9; ++i) length = length << 8 | head[i];
    if (length < 8 || length > size - at - 1) {
      corrupt(file, "the block" + place + " should be " + std::to_string(length) +
                        " bytes long, but " + std::to_string(size - at - 1) +
                        " follow: the file is truncated or corrupt");
    }
    at += 1 + length;
  }
}

/// In the process of its own: writes the VCD into `descriptor`.
[[noreturn]] void convert(const std::filesystem::path& file, int descriptor) {
  // A corrupt file may ask for any amount of time.
  constexpr rlim_t seconds_at_least = 60, bytes_per_second = 1'000'000;
  const auto seconds =
      static_cast<rlim_t>(seconds_at_least + std::filesystem::file_size(file) / bytes_per_second);
  const rlimit limit{seconds, seconds};
  ::setrlimit(RLIMIT_CPU, &limit);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) std::signal(signal, SIG_DFL);
  const int null = ::open("/dev/null", O_WRONLY);
  ::dup2(null, STDERR_FILENO);
  ::dup2(null, STDOUT_FILENO);
  FILE* out = ::fdopen(descriptor, "w");
  void* reader = fstReaderOpen(file.c_str());
  if (!out || !reader) ::_exit(2);
  fstReaderSetVcdExtensions(reader, 1);
  if (!fstReaderProcessHier(reader, out)) ::_exit(3);
  fstReaderSetFacProcessMaskAll(reader);  // not before: the header's reading forgets it
  if (!fstReaderIterBlocks(reader, nullptr, nullptr, out)) ::_exit(4);
  std::fprintf(out, "#%llu\n", static_cast<unsigned long long>(fstReaderGetEndTime(reader)));
  ::_exit(std::fflush(out) == 0 ? 0 : 5);
}

class FstSource final : public ByteSource {
 public:
  explicit FstSource(const std::filesystem::path& file) : file_(file) {
    check_blocks(file);
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) corrupt(file, std::strerror(errno));
    process_ = ::fork();
    if (process_ == 0) convert(file, ends[1]);
    ::close(ends[1]);
    descriptor_ = ends[0];
    if (process_ < 0) corrupt(file, std::strerror(errno));
  }
  ~FstSource() override {
    ::close(descriptor_);
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }
  FstSource(const FstSource&) = delete;
  FstSource& operator=(const FstSource&) = delete;

  std::size_t read(char* to, std::size_t size) override {
    for (;;) {
      const ::ssize_t count = ::read(descriptor_, to, size);
      if (count > 0) return static_cast<std::size_t>(count);
      if (count < 0 && errno == EINTR) continue;
      finish();
      return 0;
    }
  }
  bool has_lines() const override { return false; }

 private:
  void finish() {
    if (process_ <= 0) return;
    int status = 0;
    ::waitpid(process_, &status, 0);
    process_ = 0;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
    corrupt(file_, "corrupt: its blocks are as long as they say (" +
                       std::to_string(std::filesystem::file_size(file_)) +
                       " bytes), but what is in them cannot be read");
  }

  std::filesystem::path file_;
  int descriptor_ = -1;
  pid_t process_ = 0;
};

class FstWriter final : public WaveWriter {
 public:
  explicit FstWriter(const std::filesystem::path& file);
  /// Without close(): keeps what was written, or removes it if there is no value in it yet.
  ~FstWriter() override;
  FstWriter(const FstWriter&) = delete;
  FstWriter& operator=(const FstWriter&) = delete;

  Id add(std::string_view path, Kind kind, unsigned width) override;
  void begin(std::uint64_t ps, const std::vector<std::uint64_t>& values) override;
  bool begun() const override { return begun_; }
  void set_time(std::uint64_t ps) override;
  void change(Id id, std::uint64_t bits) override;
  void change_digits(Id id, std::string_view digits) override;
  void change_text(Id id, std::string_view text) override;
  void pause() override;
  void resume(const std::vector<std::uint64_t>& values) override;
  bool failed() const override { return false; }
  void close(std::uint64_t end_ps) override;

 private:
  struct Variable {
    std::uint32_t handle;
    std::uint64_t last;
    std::uint64_t mask;
  };
  void declare(const WaveScope& scope);
  void emit(Id id);
  void emit_all(const std::vector<std::uint64_t>& values);
  void finish();

  std::filesystem::path file_;
  std::optional<OutputFile> output_;
  std::optional<PartFile> hierarchy_;  ///< fstapi's own, beside it
  void* context_ = nullptr;
  bool begun_ = false;
  std::uint64_t time_ps_ = 0;
  std::vector<WaveDeclaration> declarations_;
  std::vector<Variable> variables_;
  std::string digits_;
};

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

}  // namespace

std::unique_ptr<ByteSource> open_fst_source(const std::filesystem::path& file) {
  return std::make_unique<FstSource>(file);
}

std::unique_ptr<WaveWriter> open_fst_writer(const std::filesystem::path& file) {
  return std::make_unique<FstWriter>(file);
}

}  // namespace vp
