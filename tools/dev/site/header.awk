# SPDX-License-Identifier: BSD-3-Clause
# Doxygen's view of a header: the contract in its first lines becomes the description of the file.
NR == 1 { print "//! \\file"; contract = 1; next }
contract && /^\/\/   / { print "//!     " substr($0, 6); next }
contract && /^\/\// { gsub(/[#<]/, "\\\\&"); print "//!" substr($0, 3); next }
{ contract = 0; print }
