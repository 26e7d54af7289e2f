// SPDX-License-Identifier: BSD-3-Clause
// The part of C's preprocessor that descriptions and their headers use: included files, constants, conditions.
//
// Included is `#include "file"`, from the including file's folder or the given ones. `#include <file>` is left to the
// C compiler: a description knows the types of <stdint.h>, <stdbool.h> and <stddef.h> without it. Macros with
// parameters may be defined, not used.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "modules/description/lexer.hpp"

namespace waitpoint::description {

/// The contents of a file that is included, nothing if it does not exist.
using ReadFile = std::function<std::optional<std::string>(const std::string& path)>;

struct SourceFile {
  std::string path;
  std::string contents;
};

/// A directive of the first file that concerns its C declarations: #include, #define or #undef.
struct Directive {
  std::string text;
  std::size_t begin = 0;  ///< in the file's bytes
};

struct Preprocessed {
  std::vector<Token> tokens;  ///< with an end token behind them
  std::vector<Directive> directives;
};

/// `include_folders` are tried in order behind the including file's. A missing file, an unknown directive, or #error
/// in use is BadInput.
Preprocessed preprocess(const SourceFile& source, const std::vector<std::string>& include_folders,
                        const ReadFile& read_file);

}  // namespace waitpoint::description
