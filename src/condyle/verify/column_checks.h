#pragma once

/// Many numbers of a result file follow from others of it: the strongest point of a contact from its points, a force
/// from what was read as the force. What is read is written anew, in memory, and compared with what the file holds.

#include "condyle/results/column_tree.h"
#include "condyle/results/run_file.h"
#include "condyle/verify/ledger.h"

namespace condyle::verification {

/// Every dataset of the file that condyle would write of the run: its unit, its shape and its numbers or texts, those of a
/// pose as a fault of that pose. What others have added to the file is passed over, and what an older file lacks.
void check_columns(const ColumnTree& file, const Run& run, Ledger& ledger);

}  // namespace condyle::verification
