// Makes GDAL ready before it is needed, and says what it may open.
#pragma once

namespace itin {

/// Loads GDAL, where that is not done yet, and registers the drivers of itin's output formats and of tables, which
/// takes some 30 ms. A call that will write a raster does this beside() its other work.
void make_gdal_ready();

/// Lets files that are read be opened as CSV and GeoJSON alone from now on, whatever their bytes look like: other
/// formats name further files, or are large when they are unpacked. For files that strangers have sent.
void read_tables_alone();

}  // namespace itin
