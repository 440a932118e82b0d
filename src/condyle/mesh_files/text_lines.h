#pragma once

/// Lines and words of a text format, front to back, with errors that name the line.

#include <cstddef>
#include <string_view>

#include <Eigen/Core>

#include "condyle/mesh_files/mesh_bytes.h"

namespace condyle {

/// Lines end with LF, CRLF, or CR where the text holds no LF. Words are parted by blanks.
///
/// The last line of a text that was cut short may be any beginning of a line: "1 23" of "1 234".
/// So a last line without its end is an error as soon as it is read to the end (`expect_end`).
class TextLines {
 public:
  struct Format {
    std::string_view name;      ///< for errors: "ASCII PLY"
    char comment = 0;           ///< what follows it in a line is none of the data; 0: no comments
    bool continuation = false;  ///< a backslash before the line's end joins the next line
  };
  /// `bytes` must outlive this; `text` is a part of it, whose first line is `first_line`.
  TextLines(const MeshBytes& bytes, std::string_view text, Format format, long first_line = 1);

  /// Goes on to the next line that holds a word; false where there is none.
  bool next();
  /// The next word of the line; empty at its end.
  std::string_view word();
  /// The same without taking it.
  [[nodiscard]] std::string_view peek() const;
  /// The rest of the line is of no interest.
  void skip_rest();
  /// Refuses further words in the line, and a last line without its end.
  void expect_end();
  /// Refuses a last line without its end.
  void expect_line_end();

  /// The next word as a finite number; `what` it should be, for errors: "vertex coordinate".
  double number(std::string_view what);
  Eigen::Vector3d point(std::string_view what);
  /// The next word as a whole number between the limits.
  long integer(std::string_view what, long least, long greatest);

  [[nodiscard]] long line() const { return line_; }
  /// Whether a line end was found behind this line.
  [[nodiscard]] bool ended() const { return ended_; }
  [[nodiscard]] std::size_t bytes_left() const { return rest_.size() + words_.size(); }
  /// "FILE: line N: what", and that the text may be cut short where the line has no end.
  [[noreturn]] void fail(std::string_view what) const;
  /// "FILE: NAME is cut short: what".
  [[noreturn]] void fail_cut_short(std::string_view what) const;

 private:
  bool next_physical();

  const MeshBytes& bytes_;
  Format format_;
  char end_of_line_;
  std::string_view rest_;   ///< behind this line
  std::string_view words_;  ///< what is left of this line
  long line_;
  bool ended_ = true;
};

}  // namespace condyle
