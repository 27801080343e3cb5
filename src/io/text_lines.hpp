// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Text files line by line, with errors that say where.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace mvo {

/// Reads the lines of a file that are neither empty nor comments (#), split into fields.
class LineReader {
 public:
  /// A separator of ' ' stands for any run of blanks. Throws std::runtime_error naming the file if
  /// it cannot be read.
  explicit LineReader(std::filesystem::path path, char separator = ' ');

  /// The next line's fields; false at the end of the file. A trailing carriage return is dropped.
  bool next();
  const std::vector<std::string>& fields() const { return fields_; }
  std::size_t size() const { return fields_.size(); }

  /// What errors call the fields, in their order; without, they are not called anything.
  void nameFields(std::vector<std::string> names) { names_ = std::move(names); }

  /// Field i as what it has to be; all throw std::runtime_error naming file, line and field.
  const std::string& text(std::size_t i) const;
  double number(std::size_t i) const;  ///< finite
  std::int64_t integer(std::size_t i) const;
  std::int64_t stamp(std::size_t i) const;  ///< [ns]

  /// Throws std::runtime_error("file:line: message").
  [[noreturn]] void fail(const std::string& message) const;
  /// Throws std::runtime_error("file:line: column 'name': message").
  [[noreturn]] void failField(std::size_t i, const std::string& message) const;

 private:
  std::filesystem::path path_;
  std::ifstream stream_;
  char separator_;
  std::string line_;
  std::vector<std::string> fields_;
  std::vector<std::string> names_;
  int line_number_ = 0;
};

/// A comma-separated file whose first line names its columns; further columns are ignored.
class CsvReader {
 public:
  /// Throws std::runtime_error naming the file and the column that is missing.
  CsvReader(const std::filesystem::path& path, const std::vector<std::string>& columns);

  /// The next row; false at the end. Throws if the row has not as many fields as the header.
  bool next();
  /// Field of the i-th of the columns asked for; errors as LineReader's, which also name the
  /// column.
  const std::string& text(std::size_t i) const { return lines_.text(index_[i]); }
  double number(std::size_t i) const { return lines_.number(index_[i]); }
  std::int64_t integer(std::size_t i) const { return lines_.integer(index_[i]); }
  std::int64_t stamp(std::size_t i) const { return lines_.stamp(index_[i]); }
  [[noreturn]] void fail(const std::string& message) const { lines_.fail(message); }
  [[noreturn]] void failField(std::size_t i, const std::string& message) const {
    lines_.failField(index_[i], message);
  }

 private:
  LineReader lines_;
  std::vector<std::size_t> index_;
  std::size_t columns_ = 0;
};

}  // namespace mvo
