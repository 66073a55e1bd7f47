// A child that ends with its parent.
#pragma once

namespace itin::cli {

/// Stops this process, as an interruption does, once its parent has died or has closed the pipe that is its standard
/// input. Parents that are killed cannot stop their children themselves. Lasts until the process ends. Throws Error
/// where the parent has died already.
void end_with_parent();

}  // namespace itin::cli
