// There is one writer per format; tin_export.cpp chooses among them. All write to output.temporary_path() and leave the
// commit to the caller; see tin_export.hpp for contents and errors.
#pragma once

#include <itin/tin.hpp>
#include <itin/tin_export.hpp>

#include "export/pending_file.hpp"

namespace itin {

void write_ply(const Tin& tin, const PendingFile& output, const TinExportOptions& options, Progress& progress);
void write_obj(const Tin& tin, const PendingFile& output, const TinExportOptions& options, Progress& progress);
void write_glb(const Tin& tin, const PendingFile& output, const TinExportOptions& options, Progress& progress);
void write_geopackage(const Tin& tin, const PendingFile& output, const TinExportOptions& options, Progress& progress);
void write_geojson(const Tin& tin, const PendingFile& output, const TinExportOptions& options, Progress& progress);
void write_2dm(const Tin& tin, const PendingFile& output, const TinExportOptions& options, Progress& progress);
void write_topology_json(const Tin& tin, TopologyKind kind, const PendingFile& output, const TinExportOptions& options,
                         Progress& progress);

}  // namespace itin
