// The program as a whole: finds the verb, runs it, and turns whatever happens into output and an exit status.
#pragma once

namespace itin::cli {

/// Runs the program. Returns 0: done; 1: it could not be done; 2: the call or its input is wrong; 130: interrupted.
/// Never throws.
int run(int argc, char** argv);

}  // namespace itin::cli
