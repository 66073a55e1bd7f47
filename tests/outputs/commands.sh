# What `tests/outputs/run` makes: every verb, every mode, on the bundled terrain. Each line is one command; $DEMO is
# scripts/demo-data. Files whose name ends in .json hold documents of --json, less the times and the memory they took.

# Stores: hills, hills with roads, a town, contours, scattered points, ground with a void.
gdal_translate -q -srcwin 160 320 240 240 "$DEMO/cardiff.tif" garth.tif
gdal_translate -q -srcwin 200 340 120 120 -outsize 60 60 "$DEMO/cardiff.tif" inset.tif
gdal_contour -q -a z -i 10 garth.tif contours.gpkg
gdal_translate -q -srcwin 40 40 60 60 -of XYZ garth.tif points.xyz
itin import garth.itin garth.tif --json >import-garth.json
itin import garth.itin "$DEMO/lanes.geojson" --kind roads --theme lanes --json >import-lanes.json
itin import town.itin "$DEMO/alexandria-dtm.tif" --json >import-town.json
itin import town.itin "$DEMO/alexandria-buildings.geojson" --kind buildings --height-field HEIGHT --json >import-houses.json
itin import contours.itin contours.gpkg --kind contours --z-field z --json >import-contours.json
itin import points.itin points.xyz --crs EPSG:27700 --json >import-points.json
itin info garth.itin --json >info-garth.json
itin info town.itin --json >info-town.json
itin info contours.itin --json >info-contours.json
itin check garth.itin --json >check-garth.json

# Triangulations.
itin tin garth.itin --all -o all.ply
itin tin garth.itin --all --tolerance 2 -o coarse.gpkg
itin tin garth.itin --rings 500:0,2000:1,10000:4 --disc 310375,183525,3000 -o rings.obj
itin tin garth.itin --disc 310375,183525,900 --themes lanes --topology vertex -o stars.json
itin tin garth.itin --wedge 311000,184500,30,40,2000 --topology triangle -o wedge.json
itin tin garth.itin --corridor 308600,182500,311000,185000,200 --topology edge -o corridor.json
itin tin town.itin --all --themes all -o town.glb --image town.png
itin tin town.itin --all --rings 80:0,160:16,400:32 -o town-rings.ply
itin tin contours.itin --all -o contours.geojson
itin tin contours.itin --all --lines contours --tolerance 8 -o contour-lines.gpkg
itin tin points.itin --all --tolerance 1 -o points.ply

# Cross-sections and lines of sight.
itin profile garth.itin --from 309000,183000 --to 313500,188500 --tolerance 0,2,8 -o section.csv -o section.svg
itin profile town.itin --from 321590,4297655 --to 321790,4297655 --themes buildings -o street.csv -o street.json
itin los garth.itin --from 310375,183525,10 --to 314200,189900,15 --frequency 7.5 --effective-earth 4/3 --criterion 4/3:1.0 --criterion 2/3:0.3 --report link.csv --report link.svg --report link.kml --report link.html --json >link.json
itin los town.itin --from 321590,4297655,2 --to 321790,4297662,2 --themes buildings --frequency 26 --effective-earth 4/3 --report street-link.csv --json >street-link.json
itin los town.itin --from 321590,4297655,12 --to 321790,4297662,12 --frequency 26 --effective-earth 4/3 --criterion ke:0.3 --date '1 July 2027' --report street-dated.txt --report street-dated.html --report street-dated.kml --json >street-dated.json
awk 'BEGIN { print "id,x1,y1,h1,x2,y2,h2"; for (i = 0; i < 500; ++i) print i "," 308100 + i * 37 % 9000 "," 182100 + i * 53 % 9000 ",5," 308100 + i * 71 % 9000 "," 182100 + i * 29 % 9000 ",20" }' >links.csv
itin los garth.itin --links links.csv -o links-seen.csv
itin los garth.itin --links links.csv -o links-coarse.csv --tolerance 4
itin los garth.itin --links links.csv -o links-radio.csv --frequency 6 --effective-earth 4/3

# Viewsheds in every mode, plain, at a tolerance, certified and precise.
view() { name=$1 radius=$2; shift 2; itin viewshed garth.itin --observer 310375,183525,2 --radius "$radius" --cell 20 "$@" -o "$name.tif" --json >"$name.json"; }
view visible 5000 --image visible.png --sheet visible-sheet.png --date '1 July 2027'
view tall 5000 --target-height 20
view coarse 5000 --tolerance 4
view rings 5000 --rings 500:0,2000:1,10000:4
view certified 5000 --mode certified --tolerance 8
view certified-targets 5000 --mode certified --tolerance 2 --target-height 10
view precise 5000 --precise
view precise-segments 5000 --precise --memory 5M
view height 5000 --mode height
view height-precise 5000 --mode height --precise --memory 5M
view angle 5000 --mode angle --target-height 10
view count 5000 --mode count --observer 313000,188000,10 309000,186000,30
view which 5000 --mode which --observer 313000,188000,10 309000,186000,30
view nearest 5000 --mode nearest --observer 313000,188000,10 309000,186000,30 --sheet nearest-sheet.pdf --date '1 July 2027'
view blocker 2000 --mode blocker
view probability 1500 --mode probability --vertical-error 2
view zones 4000 --target-height 2 --frequency 5.8 --effective-earth 4/3
view losses 2000 --target-height 2 --frequency 5.8 --loss --effective-earth 4/3
view wedge 5000 --azimuth 350,80 --elevation -5,2 --min-radius 300
view blocked 5000 --nodata block
itin viewshed garth.itin --absolute-heights --observer 310375,183525,320 --target-height 250 --radius 4000 --cell 25 -o absolute.tif
itin viewshed garth.itin --observer 310375,183525,2 --radius 4000 --cell 25 -o seen.gpkg --horizon horizon.csv
itin viewshed town.itin --observer 321800,4297750,2 --themes all --cell 1 -o streets.tif --features features.tif --image streets.png --json >streets.json
itin viewshed town.itin --observer 321800,4297750,2 --themes none --cell 1 -o bare.tif
itin viewshed town.itin --observer 321800,4297750,2 --themes all --cell 2 --mode certified --tolerance 1 -o streets-certified.tif
itin viewshed town.itin --observer 321800,4297750,2 --themes all --cell 2 --precise --memory 5M --target-on surface -o roofs.tif
itin viewshed town.itin --observer 321800,4297750,2 --themes all --cell 2 --mode blocker -o streets-blocker.tif
itin viewshed town.itin --observer 321800,4297750,2 --themes all --cell 2 --mode height -o streets-height.tif
itin viewshed town.itin --observer 321800,4297750,12 --target-height 1.5 --themes all --cell 3 --frequency 26 --effective-earth 4/3 -o streets-zones.tif -o streets-zones.gpkg --image streets-zones.png
itin viewshed town.itin --observer 321800,4297750,12 --target-height 1.5 --themes all --cell 4 --frequency 26 --loss --effective-earth 4/3 -o streets-losses.tif --image streets-losses.png
itin viewshed points.itin --observer 311500,190500,2 --target-height 2 --cell 20 -o points.tif
itin viewshed contours.itin --observer 310375,183525,2 --target-height 2 --radius 3000 --cell 25 -o contours.tif
itin viewshed contours.itin --observer 310375,183525,2 --target-height 2 --radius 3000 --cell 25 --mode certified --tolerance 4 -o contours-certified.tif
itin visibility garth.itin --bbox 309000,184000,311000,186000 --cell 100 --radius 1500 --observer-height 20 -o index.tif

# Turbines and sites.
printf 'x,y,hub_height,rotor_diameter,farm\n309000,185000,80,90,A\n313500,187000,60,60,B\n' >turbines.csv
printf 'x,y,name\n310375,183525,Garth Hill\n' >viewpoints.csv
itin ztv garth.itin --turbines turbines.csv --viewpoints viewpoints.csv --radius 4000 --cell 50 -o ztv
itin ztv town.itin --themes all --tip-height 60 --turbines town-turbines.csv --radius 400 --cell 5 -o ztv-town
itin ztv garth.itin --turbines turbines.csv --radar 310375,183525,20 --radius 4000 --cell 50 --sheets A3 --date '1 July 2027' -o radar
itin site garth.itin --search-area 'POLYGON((309500 183500,314500 183500,314500 188500,309500 188500,309500 183500))' --spacing 1200 --mast-height 20 --count 3 --radius 3000 --cell 50 -o masts --json >masts.json
itin site garth.itin --turbines --search-area 'POLYGON((309500 183500,314500 183500,314500 188500,309500 188500,309500 183500))' --spacing 600 --count 4 --hub-height 80 --rotor-diameter 90 --rotor-spacing 5x3 --wind-from 240 --dwellings viewpoints.csv --setback 500 --radius 3000 --cell 100 -o least-seen --json >least-seen.json
itin site garth.itin --turbines --minimise height --demand viewpoints.csv --candidates turbines.csv --count 1 --hub-height 80 --rotor-diameter 90 --radius 4000 --cell 100 -o least-height --json >least-height.json
itin site town.itin --search-area 'POLYGON((321550 4297550,322010 4297550,322010 4297970,321550 4297970,321550 4297550))' --spacing 120 --mast-height 6 --count 3 --target-height 1.5 --radius 150 --cell 2 --themes buildings -o cameras --json >cameras.json
itin site garth.itin --search-area 'POLYGON((309500 183500,314500 183500,314500 188500,309500 188500,309500 183500))' --spacing 1200 --mast-height 20 --count 3 --radius 3000 --cell 100 --frequency 5.8 --fresnel 0.6 --effective-earth 4/3 -o radio-masts --json >radio-masts.json

# Premises.
printf 'name,x,y,height\nchurch,321790,4297662,18\nmill,321900,4297850,12\n' >masts.csv
itin premises town.itin --masts masts.csv --radius 250 --pole 0,3 -o premises --json >premises.json
itin premises town.itin --masts masts.csv --radius 200 --spacing 2 --frequency 5.8 --effective-earth 4/3 -o radio-premises
itin premises town.itin --masts masts.csv --radius 120 --spacing 4 --setback 5 -o roofs
itin site town.itin --candidates masts.csv --name-field name --demand premises --place-spacing 3 --count 1 --radius 120 --cell 5 -o homes --json >homes.json
