// No request leaves the machine without --allow-network, whatever a source names; with it, requests are sent. A server
// on this machine counts them.
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cli/shell.hpp"
#include "support/listener.hpp"

namespace itin::test {

namespace {

/// In what follows, U is the address of the server and P its port.
std::string addressed(std::string text, const Listener& server) {
  text = std::regex_replace(text, std::regex("\\bU\\b"), server.address());
  return std::regex_replace(text, std::regex("\\bP\\b"), server.port());
}

class Network : public ::testing::Test {
 protected:
  Network() {
    write_hill(shell_.directory() / "hill.asc");
    shell_.run("itin import hill.itin hill.asc --quiet");
    shell_.run(R"(printf 'x,y\n301000,171000\n' > places.csv)");
  }

  void write(const std::string& name, const std::string& text) {
    std::ofstream(shell_.directory() / name) << addressed(text, server_);
  }

  Outcome run(const std::string& command) {
    return shell_.run(addressed("rm -f new.itin; export " + std::string(kServices) + "; " + command, server_));
  }

  /// `options`: of a call that reads `source`.
  void require_refusal(const std::string& call, const std::string& source) {
    const Outcome outcome = run(call);
    EXPECT_EQ(server_.take_connections(), 0) << call << "\n" << outcome.err;
    EXPECT_EQ(outcome.status, 1) << call << "\n" << outcome.err;
    const std::string named = "itin: error: " + addressed(source, server_) + ": ";
    EXPECT_TRUE(outcome.err.starts_with(named)) << call << "\n" << outcome.err;
    EXPECT_NE(outcome.err.find("and no request leaves this machine without --allow-network\n"), std::string::npos)
        << call << "\n"
        << outcome.err;
    EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
  }

  void require_request(const std::string& call) {
    const Outcome outcome = run(call + " --allow-network");
    EXPECT_GT(server_.take_connections(), 0) << call << "\n" << outcome.err;
  }

  void require_request_only_if_allowed(const std::string& verb, const std::string& source) {
    require_refusal(verb + " '" + source + "'", source);
    require_request(verb + " '" + source + "'");
  }

  static constexpr const char* kTerrain = "itin import new.itin";
  static constexpr const char* kLines = "itin import new.itin --kind contours";
  /// Services take their address from the environment.
  static constexpr const char* kServices =
      "AWS_S3_ENDPOINT=127.0.0.1:P AWS_HTTPS=NO AWS_VIRTUAL_HOSTING=FALSE AWS_NO_SIGN_REQUEST=YES CPL_GS_ENDPOINT=U/ "
      "GS_NO_SIGN_REQUEST=YES CPL_MACHINE_IS_GCE=NO OSS_ENDPOINT=127.0.0.1:P OSS_HTTPS=NO OSS_VIRTUAL_HOSTING=FALSE "
      "OSS_SECRET_ACCESS_KEY=x OSS_ACCESS_KEY_ID=x SWIFT_STORAGE_URL=U SWIFT_AUTH_TOKEN=t PL_API_KEY=k PL_URL=U/ "
      "EEDA_BEARER=b EEDA_URL=U/ CARTO_API_URL=U CARTO_API_KEY=k GDAL_HTTP_MAX_RETRY=0 PROJ_NETWORK=ON "
      "PROJ_NETWORK_ENDPOINT=U PROJ_USER_WRITABLE_DIRECTORY=. "
      "AZURE_STORAGE_CONNECTION_STRING='AccountName=a;AccountKey=a2V5;BlobEndpoint=U/a'";

  Shell shell_;
  Listener server_;
};

TEST_F(Network, NamesOfFileSystems) {
  for (const char* name : {"/vsicurl/U/a.tif",
                           "/vsicurl?url=U/a.tif",
                           "/vsicurl_streaming/U/a.tif",
                           "/vsis3/b/a.tif",
                           "/vsis3_streaming/b/a.tif",
                           "/vsigs/b/a.tif",
                           "/vsigs_streaming/b/a.tif",
                           "/vsiaz/b/a.tif",
                           "/vsiaz_streaming/b/a.tif",
                           "/vsiadls/b/a.tif",
                           "/vsioss/b/a.tif",
                           "/vsioss_streaming/b/a.tif",
                           "/vsiswift/b/a.tif",
                           "/vsiswift_streaming/b/a.tif",
                           "/vsiwebhdfs/U/webhdfs/v1/a.tif",
                           "/vsicurl/U/a.zip",
                           "/vsizip//vsicurl/U/a.zip/a.tif",
                           "/vsizip/{/vsicurl/U/a.zip}/a.tif",
                           "/vsigzip//vsicurl/U/a.tif.gz",
                           "/vsitar//vsicurl/U/a.tar/a.tif",
                           "/vsisubfile/0_100,/vsicurl/U/a.tif"})
    require_request_only_if_allowed(kTerrain, name);
}

TEST_F(Network, NamesOfServicesAndDatabases) {
  for (const char* name :
       {"U/a.tif", "WMTS:U/c.xml", "WCS:U/?", "OGCAPI:U/", "PLMosaic:mosaic=a", "STACTA:\"U/a.json\"",
        "STACIT:\"U/a.json\"", "EEDAI:image", "NETCDF:\"U/a.nc\":z", "ZARR:\"/vsicurl/U/z\"",
        "HDF5:\"/vsicurl/U/a.h5\"://z", "vrt:///vsicurl/U/a.tif?bands=1", "GTIFF_DIR:1:/vsicurl/U/a.tif",
        "DERIVED_SUBDATASET:LOGAMPLITUDE:/vsicurl/U/a.tif", "PG:host=127.0.0.1 port=P dbname=a table=t"})
    require_request_only_if_allowed(kTerrain, name);
  for (const char* name : {"U/a.geojson", "U/FeatureServer/0/query?f=json", "WFS:U/", "OAPIF:U/", "CSW:U/", "ES:U",
                           "NGW:U/resource/1", "Carto:a", "PLScenes:", "EEDA:a", "MVT:U/1", "GPKG:/vsicurl/U/a.gpkg:t",
                           "PG:host=127.0.0.1 port=P dbname=a", "MYSQL:a,host=127.0.0.1,port=P,user=u,password=p"})
    require_request_only_if_allowed(kLines, name);
}

/// These have no server to answer here, or need more of one.
TEST_F(Network, NamesThatAreRefusedUnasked) {
  for (const char* name : {"WMS:U/?SERVICE=WMS&VERSION=1.1.1&REQUEST=GetMap&LAYERS=a&SRS=EPSG:4326&BBOX=0,0,1,1",
                           "DAAS:image", "NETCDF:U/a.nc"})
    require_refusal(std::string(kTerrain) + " '" + name + "'", name);
  for (const char* name : {"MSSQL:server=127.0.0.1,P;database=a", "ODBC:DRIVER=FreeTDS;SERVER=127.0.0.1;PORT=P",
                           "GMLAS:U/a.gml", "gltp://127.0.0.1:P/vrf/a"})
    require_refusal(std::string(kLines) + " '" + name + "'", name);
}

std::string vrt_of(const std::string& source) {
  return "<VRTDataset rasterXSize='41' rasterYSize='41'><SRS>EPSG:27700</SRS>"
         "<GeoTransform>300000,50,0,172050,0,-50</GeoTransform><VRTRasterBand dataType='Float32' band='1'>"
         "<SimpleSource><SourceFilename relativeToVRT='0'>" +
         source + "</SourceFilename></SimpleSource></VRTRasterBand></VRTDataset>";
}

std::string wms_of(const std::string& service) {
  return "<GDAL_WMS>" + service +
         "<DataWindow><UpperLeftX>300000</UpperLeftX><UpperLeftY>172050</UpperLeftY>"
         "<LowerRightX>302050</LowerRightX><LowerRightY>170000</LowerRightY><SizeX>41</SizeX><SizeY>41</SizeY>"
         "</DataWindow><Projection>EPSG:27700</Projection><BandsCount>1</BandsCount><DataType>Float32</DataType>"
         "</GDAL_WMS>";
}

TEST_F(Network, RastersThatNameOthers) {
  write("curl.vrt", vrt_of("/vsicurl/U/a.tif"));
  write("http.vrt", vrt_of("U/a.tif"));
  write("nested.vrt", vrt_of("curl.vrt"));
  write("inlined.vrt", vrt_of(std::regex_replace(vrt_of("/vsicurl/U/a.tif"), std::regex("<"), "&lt;")));
  write("database.vrt", vrt_of("PG:host=127.0.0.1 port=P dbname=a schema=public table=t"));
  write("wms.xml", wms_of("<Service name='WMS'><ServerUrl>U/?</ServerUrl><Layers>a</Layers></Service>"));
  write("tms.xml", wms_of("<Service name='TMS'><ServerUrl>U/${z}/${x}/${y}.tif</ServerUrl></Service>"));
  write("wms.vrt", vrt_of("wms.xml"));
  write("wmts.xml", "<GDAL_WMTS><GetCapabilitiesUrl>U/c.xml</GetCapabilitiesUrl><Layer>a</Layer></GDAL_WMTS>");
  write("wcs.xml", "<WCS_GDAL><ServiceURL>U/?</ServiceURL><CoverageName>a</CoverageName></WCS_GDAL>");
  write("overlay.kml",
        "<kml xmlns='http://www.opengis.net/kml/2.2'><Document><Region><LatLonAltBox><north>51</north><south>50</south>"
        "<east>-3</east><west>-4</west></LatLonAltBox></Region><NetworkLink><Region><LatLonAltBox><north>51</north>"
        "<south>50</south><east>-3</east><west>-4</west></LatLonAltBox></Region><Link><href>U/0/0/0.kml</href></Link>"
        "</NetworkLink></Document></kml>");
  shell_.run("python3 -m zipfile -c in.zip curl.vrt");
  for (const char* file : {"curl.vrt", "http.vrt", "nested.vrt", "inlined.vrt", "database.vrt", "wms.xml", "tms.xml",
                           "wms.vrt", "wmts.xml", "wcs.xml", "overlay.kml", "/vsizip/in.zip/curl.vrt"})
    require_request_only_if_allowed(kTerrain, file);
}

TEST_F(Network, LayersThatNameOthers) {
  const auto layer = [](const std::string& source) {
    return "<OGRVRTDataSource><OGRVRTLayer name='a'><SrcDataSource>" + source +
           "</SrcDataSource></OGRVRTLayer></OGRVRTDataSource>";
  };
  write("http.vrt", layer("U/a.geojson"));
  write("curl.vrt", layer("/vsicurl/U/a.geojson"));
  write("database.vrt", layer("PG:host=127.0.0.1 port=P dbname=a"));
  write("wfs.xml", "<OGRWFSDataSource><URL>U/?</URL></OGRWFSDataSource>");
  write(
      "crs.geojson",
      R"({"type":"FeatureCollection","crs":{"type":"link","properties":{"href":"U/srs","type":"proj4"}},"features":[]})");
  write("type.xml",
        "<?xml version='1.0'?><!DOCTYPE a SYSTEM 'U/a.dtd'><AX_Bestandsdatenauszug "
        "xmlns='http://www.adv-online.de/namespaces/adv/gid' xmlns:gml='http://www.opengis.net/gml' "
        "xmlns:xsi='http://www.w3.org/2001/XMLSchema-instance' "
        "xsi:schemaLocation='http://www.adv-online.de/namespaces/adv/gid NAS-Operationen.xsd'/>");
  write("type.xtf",
        "<?xml version='1.0'?><!DOCTYPE a SYSTEM 'U/a.dtd'>"
        "<TRANSFER xmlns='http://www.interlis.ch/INTERLIS2.3'><HEADERSECTION/></TRANSFER>");
  for (const char* file : {"http.vrt", "curl.vrt", "database.vrt", "wfs.xml", "crs.geojson", "type.xml", "type.xtf"})
    require_request_only_if_allowed(kLines, file);
}

/// A file that was saved from a service says where it came from, and is read without asking there.
TEST_F(Network, FilesThatAreReadWithoutWhatTheyName) {
  const std::string namespaces =
      "xmlns:gml='http://www.opengis.net/gml' xmlns:xsi='http://www.w3.org/2001/XMLSchema-instance' ";
  const std::string line =
      "<gml:featureMember><a><gml:lineStringProperty><gml:LineString srsName='EPSG:27700'>"
      "<gml:posList srsDimension='3'>300000 170000 1 301000 171000 2 301000 170000 3</gml:posList>"
      "</gml:LineString></gml:lineStringProperty></a></gml:featureMember>";
  const std::string end = ">" + line + "</gml:FeatureCollection>";
  write("saved.gml", "<gml:FeatureCollection " + namespaces +
                         "xsi:schemaLocation='http://x U/wfs?SERVICE=WFS&amp;REQUEST=DescribeFeatureType'" + end);
  write("type.gml", "<!DOCTYPE a SYSTEM 'U/a.dtd'><gml:FeatureCollection " + namespaces + end);
  write("page.geojson",
        R"({"type":"FeatureCollection","links":[{"rel":"next","href":"U/items?page=2"}],"features":[{"type":"Feature",)"
        R"("properties":{},"geometry":{"type":"LineString","coordinates":[[-3,51,1],[-3.01,51,2],[-3,51.01,3]]}}]})");
  for (const char* file : {"saved.gml", "type.gml", "page.geojson"}) {
    const Outcome outcome = run("export GML_PARSER=XERCES; " + std::string(kLines) + " " + file);
    EXPECT_EQ(server_.take_connections(), 0) << file;
    EXPECT_EQ(outcome.status, 0) << file << outcome.err;
  }
}

TEST_F(Network, EveryOptionThatNamesAFile) {
  const std::string view = "itin viewshed hill.itin --quiet -o out.tif --observer 301000,171000,2 --radius 500 ";
  const std::string siting = "itin site hill.itin --quiet -o out --count 1 --radius 500 --mast-height 10 ";
  const std::vector<std::string> calls = {view + "--like",
                                          view + "--sheet map.pdf --basemap",
                                          "itin viewshed hill.itin --radius 500 -o out.tif --observers",
                                          "itin los hill.itin -o links.csv --links",
                                          "itin ztv hill.itin -o out --radius 500 --turbines",
                                          siting + "--candidates",
                                          siting + "--spacing 300 --search-area",
                                          siting + "--candidates places.csv --demand",
                                          "itin tin hill.itin -o out.ply --polygon",
                                          "itin profile hill.itin -o out.csv --path",
                                          "itin import new.itin hill.asc --sea-level 0 --sea-area"};
  for (const std::string& call : calls) require_refusal(call + " /vsicurl/U/a.geojson", "/vsicurl/U/a.geojson");
}

TEST_F(Network, GridsOfCoordinateOperations) {
  shell_.run("gdalwarp -q -t_srs EPSG:4326 hill.asc degrees.tif");
  const std::string call = "itin import new.itin degrees.tif --to-crs EPSG:27700 --quiet";
  EXPECT_EQ(run(call).status, 0);
  EXPECT_EQ(server_.take_connections(), 0);
  require_request(call);
}

}  // namespace

}  // namespace itin::test
