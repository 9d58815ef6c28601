#pragma once

#include <string_view>

namespace burin::host {

/// One line on standard error that is written over and over, if that is a terminal; nothing
/// otherwise. For rank 0.
class Progress {
 public:
  explicit Progress(bool wanted);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(std::string_view text);
  /// Wipes the line, so that another message can follow.
  void clear();

 private:
  bool active_;
  bool shown_ = false;
};

}  // namespace burin::host
