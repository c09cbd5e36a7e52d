#pragma once

namespace platform {

/// The working folder as it is now. A program that changes it with chdir() does so for itself only:
/// inputs and results are found where the user said.
class WorkingFolder {
 public:
  WorkingFolder();
  ~WorkingFolder();
  WorkingFolder(const WorkingFolder&) = delete;
  WorkingFolder& operator=(const WorkingFolder&) = delete;

  /// Goes back to it. Nothing if it could not be opened.
  void restore() const;

 private:
  int descriptor_;
};

}  // namespace platform
