// The name of this process among all that work on a job.
#pragma once

#include <string>

namespace itin::viewshed {

/// Returns the machine's name and the number of the process.
std::string runner_name();

}  // namespace itin::viewshed
