# Turns the comment that a header opens with into Doxygen's, its indented lines into code.
/^#pragma once/ && opening != "over" { if (code) print "/// @endcode"; opening = "over" }
opening == "over" || !/^\/\// { print; next }
FNR == 1 { sub(/^\/\/ /, ""); print "/// @file"; print "/// " $0; next }
/^\/\/   / { if (!code) print "/// @code{.cpp}"; code = 1; sub(/^\/\/   /, "/// "); print; next }
{ if (code) print "/// @endcode"; code = 0; sub(/^\/\//, "///"); print }
