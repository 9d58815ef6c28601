#pragma once

#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace burin::node {

/// Decides the conditional lines of GLSL when a program is generated, instead of leaving that to
/// the driver: the program's text is then what is used, whatever else the shader files know. The
/// text's own #define lines decide.
///
/// Known are #ifdef NAME, #if and #elif with defined(NAME) joined by || alone or by && alone, #else
/// and #endif. BURIN_CHECKs that there is nothing else and that they are nested.
class ShaderConditions {
 public:
  /// Of the text's next line, without its comment: whether it is in the program. Conditional lines
  /// are not.
  bool keeps(std::string_view line);
  /// Whether every #if so far has had its #endif.
  bool isClosed() const { return branches_.empty(); }

 private:
  /// A conditional that is not closed yet.
  struct Branch {
    bool isOpen;  // the part of it that has been reached is in the program
    bool isDone;  // none of those that follow is
  };
  bool isOpen() const { return branches_.empty() || branches_.back().isOpen; }
  void begin(bool condition);
  void turn(bool condition);
  void end();
  bool holds(std::string_view expression) const;

  std::set<std::string, std::less<>> defined_;
  std::vector<Branch> branches_;
};

}  // namespace burin::node
