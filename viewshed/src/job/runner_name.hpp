// The name of this process among all that work on a job.
#pragma once

#include <string>

namespace itin::viewshed {

/// Returns the machine's name, the number of the process, and a number drawn at random for it: machines that were
/// copied, or containers, may have the other two in common. The last follows the last dot.
std::string runner_name();

}  // namespace itin::viewshed
