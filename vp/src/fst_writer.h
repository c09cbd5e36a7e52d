#pragma once

#include <vp/output_file.h>
#include <vp/wave_writer.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "wave_scope.h"

namespace vp {

/// Writes GTKWave's FST through its own fstapi: some 30 times smaller than a VCD. Compiled in where
/// Debian's package `verilator` brings the sources of fstapi.
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

}  // namespace vp
