// The toolkit's errors as Python's.
#pragma once

namespace itin::python {

/// Raises itin::Error and the errors derived from it as the classes of itin/_errors.py, with their data.
void translate_errors();

}  // namespace itin::python
