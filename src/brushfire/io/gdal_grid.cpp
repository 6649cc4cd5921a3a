// GDAL's C interface.
#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/io/detail/gdal_grid.h>
#include <brushfire/io/detail/output.h>

#ifdef BRUSHFIRE_HAS_GDAL
#include <brushfire/core/detail/memory.h>

#include <cpl_vsi.h>
#include <gdal.h>
#include <ogr_srs_api.h>

#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <string_view>
#include <utility>
#include <vector>
#endif

namespace brushfire::detail {

#ifndef BRUSHFIRE_HAS_GDAL

Grid read_gdal(const std::string& path) {
  throw Error(ErrorCode::UnknownFormat, path +
                                            ": this build has no GDAL and reads grids from .asc (ESRI ASCII grid) and "
                                            ".npy; 'gdal_translate -of AAIGrid " +
                                            path + " grid.asc' makes one");
}

void write_geotiff(const std::string& path, const Grid&) {
  throw Error(ErrorCode::UnknownFormat, path +
                                            ": this build has no GDAL and writes grids as .asc (ESRI ASCII grid) and "
                                            ".npy; gdal_translate makes a GeoTIFF of the former");
}

#else

namespace {

struct Close {
  void operator()(void* set) const { GDALClose(set); }
};
using Dataset = std::unique_ptr<void, Close>;

// GDAL's messages, which would go to stderr, are kept for ours.
class Quietly {
 public:
  Quietly() {
    static std::once_flag once;
    std::call_once(once, GDALAllRegister);
    CPLErrorReset();
    CPLPushErrorHandler(CPLQuietErrorHandler);
  }
  Quietly(const Quietly&) = delete;
  Quietly& operator=(const Quietly&) = delete;
  ~Quietly() { CPLPopErrorHandler(); }

  [[noreturn]] static void fail(ErrorCode code, const std::string& path, const std::string& what) {
    const std::string_view said = CPLGetLastErrorMsg();
    throw Error(code, path + ": " + what + (said.empty() ? "" : " (GDAL: " + std::string(said) + ")"));
  }
};

GridPlacement placement_of(GDALDatasetH set) {
  std::array<double, 6> t{0, 1, 0, 0, 0, -1};
  GDALGetGeoTransform(set, t.data());
  return {{t[0] + 0.5 * (t[1] + t[2]), t[3] + 0.5 * (t[4] + t[5])}, {t[1], t[4]}, {t[2], t[5]}};
}

std::array<double, 6> transform_of(const GridPlacement& p) {
  return {p.origin[0] - 0.5 * (p.right[0] + p.down[0]), p.right[0], p.down[0],
          p.origin[1] - 0.5 * (p.right[1] + p.down[1]), p.right[1], p.down[1]};
}

// Degrees beside metres of height would make nonsense of lengths and slopes.
void refuse_degrees(GDALDatasetH set, const std::string& path) {
  const OGRSpatialReferenceH reference = GDALGetSpatialRef(set);
  if (reference == nullptr || OSRIsGeographic(reference) == 0) return;
  throw Error(ErrorCode::InvalidArgument, path +
                                              ": its map is in degrees, and its heights are not; 'gdalwarp -t_srs "
                                              "EPSG:32632 " +
                                              path + " metres.tif' (of your own zone) makes metres of both");
}

void read_rows(GDALRasterBandH band, const std::string& path, Grid& grid) {
  int has_scale = 0, has_offset = 0;
  const double scale = GDALGetRasterScale(band, &has_scale), offset = GDALGetRasterOffset(band, &has_offset);
  const GDALRasterBandH mask = GDALGetMaskBand(band);
  const auto width = static_cast<int>(grid.columns);
  std::vector<unsigned char> is_there(grid.columns);
  Poll poll(1);
  for (Index r = 0; r < grid.rows; ++r) {
    poll();
    double* row = grid.heights.data() + std::size_t{r} * grid.columns;
    const int y = static_cast<int>(r);
    if (GDALRasterIO(band, GF_Read, 0, y, width, 1, row, width, 1, GDT_Float64, 0, 0) != CE_None ||
        GDALRasterIO(mask, GF_Read, 0, y, width, 1, is_there.data(), width, 1, GDT_Byte, 0, 0) != CE_None) {
      Quietly::fail(ErrorCode::FileMalformed, path, "row " + std::to_string(r) + " cannot be read");
    }
    for (Index c = 0; c < grid.columns; ++c) {
      const double height = (has_scale != 0 ? scale : 1) * row[c] + (has_offset != 0 ? offset : 0);
      row[c] = is_there[c] != 0 && std::isfinite(height) ? height : kInfinity;
    }
  }
}

// A file of GDAL's in memory.
class MemoryFile {
 public:
  MemoryFile() {
    static std::atomic<unsigned> count{0};
    name_ = "/vsimem/brushfire-" + std::to_string(count++) + ".tif";
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { VSIUnlink(name_.c_str()); }

  const char* name() const { return name_.c_str(); }
  std::string_view bytes() const {
    vsi_l_offset size = 0;
    const GByte* data = VSIGetMemFileBuffer(name_.c_str(), &size, FALSE);
    return {reinterpret_cast<const char*>(data), static_cast<std::size_t>(size)};
  }

 private:
  std::string name_;
};

void write_rows(GDALDatasetH set, const std::string& path, const Grid& grid) {
  std::array<double, 6> transform = transform_of(grid.placement);
  GDALSetGeoTransform(set, transform.data());
  if (!grid.reference.empty()) GDALSetProjection(set, grid.reference.c_str());
  const GDALRasterBandH band = GDALGetRasterBand(set, 1);
  GDALSetRasterNoDataValue(band, std::numeric_limits<double>::quiet_NaN());
  const auto width = static_cast<int>(grid.columns);
  Poll poll(1);
  for (Index r = 0; r < grid.rows; ++r) {
    poll();
    std::vector<double> row(grid.heights.begin() + std::ptrdiff_t{r} * grid.columns,
                            grid.heights.begin() + (std::ptrdiff_t{r} + 1) * grid.columns);
    for (double& v : row) {
      if (!std::isfinite(v)) v = std::numeric_limits<double>::quiet_NaN();
    }
    if (GDALRasterIO(band, GF_Write, 0, static_cast<int>(r), width, 1, row.data(), width, 1, GDT_Float64, 0, 0) !=
        CE_None) {
      Quietly::fail(ErrorCode::FileNotWritable, path, "row " + std::to_string(r) + " cannot be written");
    }
  }
}

}  // namespace

Grid read_gdal(const std::string& path) {
  const Quietly quietly;
  const Dataset set(GDALOpenEx(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, nullptr, nullptr, nullptr));
  if (!set) Quietly::fail(ErrorCode::FileNotReadable, path, "no grid that GDAL reads");
  refuse_degrees(set.get(), path);
  Grid grid;
  grid.columns = static_cast<Index>(GDALGetRasterXSize(set.get()));
  grid.rows = static_cast<Index>(GDALGetRasterYSize(set.get()));
  if (GDALGetRasterCount(set.get()) < 1) Quietly::fail(ErrorCode::FileMalformed, path, "it has no band");
  grid.placement = placement_of(set.get());
  grid.reference = GDALGetProjectionRef(set.get());
  const std::size_t count = std::size_t{grid.columns} * grid.rows;
  require_memory(count * sizeof(double), 0, path, "cut out what you need with gdal_translate -projwin");
  grid.heights.resize(count);
  read_rows(GDALGetRasterBand(set.get(), 1), path, grid);
  return grid;
}

void write_geotiff(const std::string& path, const Grid& grid) {
  const Quietly quietly;
  const MemoryFile file;
  std::array<char, 17> compress{"COMPRESS=DEFLATE"};
  std::array<char*, 2> options{compress.data(), nullptr};
  Dataset set(GDALCreate(GDALGetDriverByName("GTiff"), file.name(), static_cast<int>(grid.columns),
                         static_cast<int>(grid.rows), 1, GDT_Float64, options.data()));
  if (!set) Quietly::fail(ErrorCode::FileNotWritable, path, "GDAL makes no GeoTIFF");
  write_rows(set.get(), path, grid);
  set.reset();
  Output out(path);
  out.write(file.bytes());
  out.commit();
}

#endif

}  // namespace brushfire::detail
