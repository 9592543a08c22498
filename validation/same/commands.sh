# What `cargo xtask same COMMIT` runs with the programs of two commits, one line each, in an empty folder that
# holds links to the folders of the repository. The commands of the documentation are run as well.

# rock
freestand rock --json --motion validation/rocking/records/synthfloor.csv --scale 3.5 --height 1.8m --thickness 0.5m --mass 150kg --stiffness '4380 N/mm'
freestand rock --json --motion validation/rocking/records/synthfloor.csv --scale 8 --height 1.8m --thickness 0.4m --history history.csv
freestand rock --json --motion validation/rocking/records/onesine_T1.0.csv --height 1.5m --thickness 0.3m
freestand rock --json --motion validation/rocking/records/onesine_T1.0.csv --height 1.5m --thickness 0.3m --duration 1s
freestand rock --json --motion validation/rocking/records/decsine_f1.25.csv --height 1.2m --thickness 0.4m --restitution 0.9 --accuracy tight
freestand rock --json --motion validation/rocking/records/decsine_f1.25.csv --height 1.2m --thickness 0.4m --model linear --accuracy fast
freestand rock --json --motion validation/rocking/records/decsine_f1.25.csv validation/rocking/records/onesine_T1.0.csv validation/rocking/records/synthfloor.csv --height 1.2m --thickness 0.4m --out rocked
freestand rock --json --initial-rotation 3deg --height 2m --thickness 0.5m --duration 4s
freestand rock --json --initial-velocity '0.4 rad/s' --height 2m --thickness 0.5m --restitution-factor 0.9
freestand rock --json --motion validation/rocking/records/synthfloor_hv.csv --component 1 --vertical validation/rocking/records/synthfloor_hv.csv --vertical-component 2 --vertical-scale 0.5 --scale 4 --height 1.6m --thickness 0.4m
freestand rock --motion validation/rocking/records/synthfloor.csv --scale 4 --height 6ft --thickness 18in --mass 300lb --stiffness '25000 lbf/in' --out rocked --parquet
freestand rock --json --motion validation/rocking/records/synthfloor.csv --scale 6 --height 1.8m --thickness 0.4m --mass 100kg --wall-gap-left 30mm --wall-restitution 0.3
freestand rock --json --motion validation/rocking/records/synthfloor.csv --scale 6 --height 1.8m --thickness 0.4m --wall-gap-left 10mm --wall-gap-right 10mm --wall-restitution 0.5
freestand rock --json --motion validation/rocking/records/synthfloor.csv --scale 8 --sliding --friction 0.25 --friction-kinetic 0.2 --height 0.8m --thickness 0.6m
freestand rock --json --motion validation/rocking/records/synthfloor.csv --scale 4 --casters --clearance-left 100mm --clearance-right 100mm --height 1.4m --thickness 0.6m
freestand rock --json --motion validation/rocking/records/synthfloor_hv.csv --component 2 --sliding --friction 0.2 --height 0.8m --thickness 0.6m --scale 6

# compliant
freestand rock --json --base compliant --stiffness '4000 N/mm' --mass 150kg --law kelvin-voigt --damping 5% --motion validation/rocking/records/synthfloor.csv --scale 4 --height 1.8m --thickness 0.5m
freestand rock --json --base compliant --stiffness '4000 N/mm' --mass 150kg --motion validation/rocking/records/synthfloor.csv --scale 4 --height 1.8m --thickness 0.5m --history history.csv --out on-pads
freestand rock --json --base compliant --stiffness '4000 N/mm' --mass 150kg --law hunt-crossley --dissipation '0.3 s/m' --motion validation/rocking/records/decsine_f1.25.csv --scale 0.5 --height 1.8m --thickness 0.5m
freestand rock --json --base compliant --stiffness '4000 N/mm' --mass 150kg --law kelvin-voigt --damping 10% --friction 0.4 --motion validation/rocking/records/synthfloor.csv --scale 4 --height 1.8m --thickness 0.5m
freestand rock --json --base compliant --stiffness '4000 N/mm' --mass 150kg --law kelvin-voigt --damping 5% --width 0.7m --motion validation/rocking/records/synthfloor_hv.csv --components both --scale 4 --height 1.8m --thickness 0.5m --accuracy fast
freestand rock --json --base compliant --stiffness '4000 N/mm' --mass 150kg --law kelvin-voigt --damping 5% --upper-height 0.4m --upper-thickness 0.3m --upper-mass 30kg --motion validation/rocking/records/synthfloor.csv --scale 3 --height 0.9m --thickness 0.5m --accuracy fast
freestand rock --json --base compliant --stiffness '4000 N/mm' --mass 150kg --law kelvin-voigt --damping 5% --wall-gap-left 20mm --motion validation/rocking/records/synthfloor.csv --scale 5 --height 1.8m --thickness 0.5m
freestand rock --json --base compliant --cg-rise 16mm --height 2.3m --thickness 0.6m --mass 140kg --stiffness '4380 N/mm' --law kelvin-voigt --damping 5%

# spectrum
freestand spectrum --json --motion validation/rocking/records/synthfloor.csv --scale 3.5 --heights '1 m:2.4 m:4' --thicknesses '0.2 m:0.6 m:3' --mass 150kg --stiffness '4380 N/mm'
freestand spectrum --json --motion validation/rocking/records/synthfloor.csv validation/rocking/records/onesine_T1.0.csv validation/rocking/records/decsine_f1.25.csv --heights '1 m:2.4 m:4' --thicknesses '0.2 m:0.6 m:3' --out spectra --parquet spectra.parquet
freestand spectrum --json --motion validation/rocking/records/decsine_f1.25.csv --heights '1 m, 2 m' --thicknesses '0.3 m' --model linear --accuracy tight
freestand spectrum --json --motion validation/rocking/records/onesine_T1.0.csv --heights '0.5 m:4 m:32' --thicknesses '0.1 m:1 m:32' --accuracy fast
freestand spectrum --json --place Wellington --count 2 --level-ratio 1 --storeys 6 --heights '1 m, 2 m' --thicknesses '300 mm'
freestand spectrum --json --motion validation/rocking/records/synthfloor.csv --scale 6 --heights '1.8 m' --thicknesses '0.4 m, 0.5 m' --wall-gap-left 30mm

# shock
freestand shock --json --height 2.3m --thickness 0.6m --mass 140kg --stiffness '4380 N/mm' --cg-rise 16mm --scenario rocking --model paper
freestand shock --json --height 2.3m --thickness 0.6m --mass 140kg --stiffness '4380 N/mm' --cg-rise 16mm --scenario rocking --model halted
freestand shock --json --height 2.3m --thickness 0.6m --mass 140kg --stiffness '4380 N/mm' --cg-rise 16mm --scenario rocking --model free-corner
freestand shock --json --height 2.3m --thickness 0.6m --mass 140kg --pad-stiffness '2190 N/mm' --pads-per-edge 2 --series-stiffness '9000 N/mm' --uplift 40mm --tolerance '5 g' --tolerance-duration '11 ms' --tolerance-velocity-change '2 m/s'
freestand shock --json --height 2.3m --thickness 0.6m --mass 140kg --drop-acceleration '9.8 g'
freestand shock --json --height 2m --thickness 0.5m --mass 140kg --scenario overturn-floor --contact-stiffness '1000 N/mm'
freestand shock --json --height 2m --thickness 0.5m --mass 140kg --scenario overturn-obstacle --contact-stiffness '1000 N/mm' --gap 0.3m --obstacle-height 1.2m
freestand shock --json --height 2.3m --thickness 0.6m --mass 140kg --stiffness '4380 N/mm' --rotation 3deg --at '0.1 m, 1.5 m' --cg-height 1m
freestand shock --height 6ft --thickness 24in --mass 300lb --stiffness '25 kip/in' --uplift 1in
freestand shock-spectrum --json --pulse half-sine --peak-acceleration '30 g' --duration '11 ms' --frequencies '20 Hz, 45 Hz, 200 Hz'
freestand shock-spectrum --json --pulse terminal-peak-sawtooth --peak-acceleration '30 g' --duration '6 ms' --frequencies '10 Hz:1 kHz:6/oct' --kind pseudo-velocity --peak primary
freestand shock-spectrum --json validation/cushion/drop-001.csv --frequencies '20 Hz:2 kHz:3/oct' --out srs

# motion
freestand motion info --json fuzz/seeds/at2/crlf.at2
freestand motion info --json fuzz/seeds/at2/nga1.at2
freestand motion info --json fuzz/seeds/at2/nga2.at2
freestand motion info --json fuzz/seeds/bhrc/vol1.v1
freestand motion info --json fuzz/seeds/columns/comma.csv
freestand motion info --json fuzz/seeds/columns/semicolon.csv
freestand motion info --json fuzz/seeds/columns/comments.txt
freestand motion info --json fuzz/seeds/cosmos/corrected.v2c
freestand motion info --json fuzz/seeds/csmip/pairs.v1
freestand motion info --json fuzz/seeds/csmip/renadic.v1
freestand motion info --json fuzz/seeds/csmip/uncorrected.v1
freestand motion info --json fuzz/seeds/csmip_v2/corrected.v2
freestand motion info --json fuzz/seeds/cwa/quake.txt
freestand motion info --json fuzz/seeds/cwa/station.txt
freestand motion info --json fuzz/seeds/esm/afad.asc
freestand motion info --json fuzz/seeds/esm/dyna.asc
freestand motion info --json fuzz/seeds/geonet/corrected.v2a
freestand motion info --json fuzz/seeds/geonet/uncorrected.v1a
freestand motion info --json fuzz/seeds/knet/borehole.UD1
freestand motion info --json fuzz/seeds/knet/surface.NS
freestand motion info --json fuzz/seeds/nsmn/old.txt
freestand motion info --json validation/rocking/records/synthfloor.csv validation/rocking/records/synthfloor_hv.csv validation/rocking/records/onesine_T1.0.csv --out info --parquet
freestand motion info validation/rocking/records/synthfloor.csv
freestand motion spectrum --json validation/rocking/records/synthfloor.csv --damping 5% --periods '0.1 s:2 s:8'
freestand motion convert validation/rocking/records/synthfloor.csv --to at2 --out converted
freestand motion convert validation/rocking/records/synthfloor.csv --to csv --baseline linear --taper 5% --low-cut '0.1 Hz' --out converted
freestand motion rotd --json validation/rocking/records/synthfloor_hv.csv --periods '0.1 s:2 s:8'
freestand motion rotate validation/rocking/records/synthfloor_hv.csv --to 30deg --azimuths '0 deg, 90 deg' --out turned
freestand motion synth --json --code as1170.4 --site De --hazard-factor 0.08 --return-period 500 --count 2 --seed 3 --out synth
freestand motion synth --json --code eurocode8 --site B --ground-acceleration '0.15 g' --spectrum-type 1 --count 1 --seed 5
freestand motion match validation/rocking/records/synthfloor.csv --code as1170.4 --site De --hazard-factor 0.08 --out matched --json
freestand motion simulate --json --magnitude 6.5 --distance 20km --count 2 --out simulated
freestand motion code-spectrum --json --code as1170.4 --site De --hazard-factor 0.08 --periods '0 s, 0.1 s, 0.5 s, 1 s, 2 s'
freestand motion code-spectrum --json --code nzs1170.5 --site C --hazard-factor 0.4 --periods '0 s, 0.5 s, 1 s'
freestand motion code-spectrum --json --code asce7 --sds '1 g' --sd1 '0.6 g' --periods '0 s, 0.5 s, 1 s'

# places
freestand place show Wellington --json
freestand object --json --height 1.8m --thickness 0.4m --width 0.6m --place Wellington --floor 2 --storeys 4 --worlds 40
freestand place show Lisbon --json
freestand object --json --height 1.8m --thickness 0.4m --width 0.6m --place Lisbon --floor 2 --storeys 4 --worlds 40
freestand place show Bucharest --json
freestand object --json --height 1.8m --thickness 0.4m --width 0.6m --place Bucharest --floor 2 --storeys 4 --worlds 40
freestand place show Nice --json
freestand object --json --height 1.8m --thickness 0.4m --width 0.6m --place Nice --floor 2 --storeys 4 --worlds 40
freestand place show Oakland --json
freestand object --json --height 1.8m --thickness 0.4m --width 0.6m --place Oakland --floor 2 --storeys 4 --worlds 40
freestand place show Melbourne --json
freestand object --json --height 1.8m --thickness 0.4m --width 0.6m --place Melbourne --floor 2 --storeys 4 --worlds 40
freestand place show Christchurch --json
freestand object --json --height 1.8m --thickness 0.4m --width 0.6m --place Christchurch --floor 2 --storeys 4 --worlds 40
freestand place list --json

# object
freestand object --json --height 1.8m --thickness 0.4m --motion validation/rocking/records/synthfloor.csv --scale 3.5 --mass 150kg --on '4380 N/mm' --tolerance '10 g'
freestand object --json --height 1.8m --thickness 0.4m --motion validation/rocking/records/synthfloor.csv validation/rocking/records/onesine_T1.0.csv validation/rocking/records/decsine_f1.25.csv --width 0.6m
freestand object --json --height 1.8m --thickness 0.4m --motion validation/rocking/records/synthfloor.csv --scales '1, 3, 3.5, 4'
freestand object --json --height 1.8m --thickness 0.4m --pga '0.3 g' --worlds 20
freestand object --json --height 1.8m --thickness 0.4m --place Wellington --worlds 20 --wall-gap 30mm --wall-restitution 0.4 --floor 1 --storeys 3
freestand object --json --height 1.8m --thickness 0.4m --place Wellington --worlds 20 --casters free --clearance 100mm
freestand object --json --height 1.8m --thickness 0.4m --place Wellington --worlds 20 --friction 0.15
freestand object --json --height 1.8m --thickness 0.4m --place Wellington --worlds 20 --mass 150kg --on '4380 N/mm' --floor 2 --storeys 3
freestand object --json --height 1.8m --thickness 0.4m --place Wellington --worlds 10 --mass 150kg --on '4380 N/mm' --upper-height 0.4m --upper-thickness 0.3m --upper-mass 30kg
freestand object --json --height 1.8m --thickness 0.4m --place Melbourne --shape cylinder --worlds 20
freestand object --json --height 1.8m --thickness 0.4m --place Wellington --worlds 20 --out object
freestand object --height 6ft --thickness 18in --place Oakland --worlds 20

# restrain
freestand restrain --json --height 1.8m --thickness 0.6m --width 0.9m --mass 360kg --place Wellington --floor 2 --storeys 4
freestand restrain --json --height 1.8m --thickness 0.6m --width 0.9m --mass 360kg --place Lisbon --floor 2 --storeys 4 --component cabinet
freestand restrain --json --height 1.8m --thickness 0.6m --width 0.9m --mass 360kg --code asce7 --edition 2016 --sds '1 g' --level-ratio 1 --importance 1.5 --component cabinet
freestand restrain --json --height 1.8m --thickness 0.6m --width 0.9m --mass 360kg --place Melbourne --compare --out restraint
freestand restrain examples/hospital/inventory.csv --study examples/hospital/study.toml --json
freestand restrain --height 1.8m --thickness 0.6m --width 0.9m --mass 360kg --place 'Los Angeles' --units us

# floor
freestand floor --json --motion validation/rocking/records/synthfloor.csv --storeys 30 --storey-height 3.2m --modes 3 --levels '0, 0.5, 1' --out floors
freestand floor --json --motion validation/rocking/records/synthfloor.csv --storeys 6 --storey-height 3m --period 0.6s --damping 3% --shear-flexure 1 --levels '0.5, 1' --parquet --out floors
freestand floor --json --motion validation/rocking/records/synthfloor_hv.csv --components both --storeys 6 --storey-height 3m --levels 1

# cushion
freestand cushion drop --json validation/cushion/drop-001.csv validation/cushion/drop-002.csv validation/cushion/drop-003.csv --out drops
freestand cushion drop --json validation/cushion/drop-001.csv --law cubic
freestand cushion drop --json validation/cushion/drop-001.csv --mass 1kg
freestand cushion simulate --law power --stiffness '4380 N/mm' --mass 0.4kg --height 100mm --sample-rate '50 kHz' --noise 0.5% --seed 3 --count 2 --out virtual --json; freestand cushion drop --json virtual/drop-001.csv
freestand cushion simulate --law kelvin-voigt --damping 10% --stiffness '2000 N/mm' --mass 0.4kg --height 200mm --sample-rate '50 kHz' --noise 0.5% --zero-shift 0.2% --out virtual --json; freestand cushion drop --json virtual/drop-001.csv
freestand cushion list --json
freestand tolerance list --json
freestand tolerance search cabinet --json
freestand tolerance show rack-server-operating --json

# inventory
freestand inventory check crates/freestand-inventory/tests/lists/deutsch.csv --json --storeys 5
freestand inventory check crates/freestand-inventory/tests/lists/english_si.csv --json --storeys 5
freestand inventory check crates/freestand-inventory/tests/lists/espanol.tsv --json --storeys 5
freestand inventory check crates/freestand-inventory/tests/lists/francais.csv --json --storeys 5
freestand inventory check crates/freestand-inventory/tests/lists/italiano.csv --json --storeys 5
freestand inventory check crates/freestand-inventory/tests/lists/lwh_kn.csv --json --storeys 5
freestand inventory check crates/freestand-inventory/tests/lists/mixed.csv --json --storeys 5
freestand inventory check crates/freestand-inventory/tests/lists/nihongo.csv --json --storeys 5
freestand inventory check crates/freestand-inventory/tests/lists/sizes.csv --json --storeys 5
freestand inventory check crates/freestand-inventory/tests/lists/two_tables.csv --json --storeys 5
freestand inventory check crates/freestand-inventory/tests/lists/unitless.csv --json --storeys 5
freestand inventory check crates/freestand-inventory/tests/lists/us_fema_e74.csv --json --storeys 5
freestand inventory check examples/hospital/inventory.csv --json --storeys 5
freestand inventory check examples/museum/inventory.csv --json --storeys 5
freestand inventory check examples/server-room/inventory.xlsx --json --storeys 5
freestand inventory check examples/server-room/inventory.csv --json --storeys 5
freestand inventory check crates/freestand-inventory/tests/lists/deutsch.csv --storeys 5 --out checked
freestand inventory convert crates/freestand-inventory/tests/lists/deutsch.csv --to xlsx --out converted --json
freestand inventory template --out template
freestand inventory check crates/freestand-inventory/tests/lists/us_fema_e74.csv --units us --storeys 5

# assess
freestand assess crates/freestand-cli/tests/same_answer/study.toml --inventory crates/freestand-cli/tests/same_answer/list.csv --outcomes --out assessed --json --format csv,parquet
freestand assess crates/freestand-cli/tests/same_answer/study.toml --inventory crates/freestand-cli/tests/same_answer/list.csv --out assessed --json; freestand assess crates/freestand-cli/tests/same_answer/study.toml --inventory crates/freestand-cli/tests/same_answer/list.csv --out assessed --resume --json
freestand shard plan crates/freestand-cli/tests/same_answer/study.toml --inventory crates/freestand-cli/tests/same_answer/list.csv --shards 3 --out shards --json; freestand shard run shards --shard 0 --json; freestand shard run shards --shard 1 --json; freestand shard run shards --shard 2 --json; freestand shard merge shards --out merged --json
freestand assess --place Wellington --storeys 3 --inventory validation/same/few.csv --out assessed --json
freestand assess --inventory validation/same/few.csv --out assessed --json
freestand assess --place Lisbon --storeys 3 --inventory crates/freestand-cli/tests/same_answer/list.csv --out assessed --json --edit 'D2=410' --date 2026-01-01 --preparer 'A. Person'
freestand assess validation/same/study.toml --inventory validation/same/list.csv --out assessed --json --cards --pages 5
freestand assess validation/same/space.toml --inventory validation/same/list.csv --out assessed --json --outcomes
freestand check examples/hospital/study.toml --json
freestand check validation/models/study.toml --json
freestand check examples/museum/study.toml

# fragility
freestand fragility crates/freestand-cli/tests/same_answer/study.toml --inventory crates/freestand-cli/tests/same_answer/list.csv --method cloud --im 'pfv, pfa' --bootstrap 20 --out fragile --json
freestand fragility crates/freestand-cli/tests/same_answer/study.toml --inventory crates/freestand-cli/tests/same_answer/list.csv --method ida --scales '0.5:3:4' --im 'pfv, pfa' --bootstrap 20 --out fragile --json
freestand fragility crates/freestand-cli/tests/same_answer/study.toml --inventory crates/freestand-cli/tests/same_answer/list.csv --method stripes --scales '0.1 m/s:1 m/s:3' --im 'pfv, pfa' --bootstrap 20 --out fragile --json
freestand fragility --height 1.8m --thickness 0.4m --mass 150kg --stiffness '4380 N/mm' --tolerance 2g --motion validation/rocking/records/synthfloor.csv validation/rocking/records/onesine_T1.0.csv validation/rocking/records/decsine_f1.25.csv --im 'pfv, pfa' --out fragile --json --parquet
freestand fragility --height 1.8m --thickness 0.4m --mass 150kg --stiffness '4380 N/mm' --tolerance 2g --motion validation/rocking/records/synthfloor.csv validation/rocking/records/onesine_T1.0.csv validation/rocking/records/decsine_f1.25.csv --fit two-stage --json
freestand fragility --outcomes examples/risk/outcomes.csv --json --bootstrap 100 --out fitted
freestand fragility --outcomes examples/risk/outcomes.csv --json --fit separate
freestand risk --fragility examples/risk/curves.csv --hazard examples/risk/hazard.csv --json --out risk
freestand risk --outcomes examples/risk/outcomes.csv --bootstrap 100 --hazard examples/risk/hazard.csv --inventory examples/risk/costs.csv --options examples/risk/options.csv --json --out risk
freestand fragility crates/freestand-cli/tests/same_answer/study.toml --inventory crates/freestand-cli/tests/same_answer/list.csv --method cloud --bootstrap 0 --out fragile --json; freestand risk --outcomes fragile/outcomes.csv --bootstrap 0 --hazard-power 'k0=1e-2 /yr, k=2.5, reference=0.5 m/s' --hazard-im pfv --json

# run
freestand run fuzz/seeds/study_toml/small.toml --out run --json
freestand run --dump-study
freestand run --motion validation/rocking/records/synthfloor.csv --out run --json --set objects.heights='1 m, 2 m'
freestand validate --json
freestand completions bash

# refused
freestand rock --motion validation/rocking/records/synthfloor.csv --height 1.8 --thickness 0.4m
freestand rock --height 1.8m --thickness 0.4m
freestand place show Nowhere
freestand shock --height 2.3m --thickness 0.6m --mass 140kg --stiffness '4380 N/mm' --cg-rise 16mm --scenario halted --model paper
freestand rock --motion validation/rocking/records/synthfloor.csv --height -1m --thickness 0.4m --unit parsec
freestand rock --motion nothing.csv --height 1m --thickness 0.4m
freestand object --height 1.8m
freestand object --height 1.8m --thickness 0.4m --place Wellingtn
freestand object --height 1800m --thickness 0.4m --place Wellington
freestand assess nothing.toml
freestand assess --inventory examples/risk/hazard.csv
freestand fragility --outcomes examples/risk/hazard.csv
freestand risk --fragility examples/risk/curves.csv
freestand spectrum --heights '1 m' --thicknesses '1 m'
freestand shock --height 2m --thickness 0.5m --mass 140kg --stiffness '4380 N/mm'
freestand floor --storeys 3
freestand motion info
freestand cushion drop nothing.csv
freestand inventory check nothing.csv
freestand restrain --mass 100kg
freestand rock --motion validation/rocking/records/synthfloor.csv --height 1.8m --thickness 0.4m --nonsense 3
