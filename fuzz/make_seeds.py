"""Writes fuzz/seeds: small files of every family, from the formats' descriptions; no recorded motion is in them.

    python3 fuzz/make_seeds.py
"""

import math
import struct
from pathlib import Path

SEEDS = Path(__file__).parent / "seeds"
N = 40
# A damped sine of 100 units; any motion would do.
A = [100.0 * math.exp(-0.05 * i) * math.sin(0.6 * i) for i in range(N)]


def put(family, name, data):
    if isinstance(data, str):
        data = data.encode("latin-1")
    assert len(data) <= 4096, (family, name, len(data))
    folder = SEEDS / family
    folder.mkdir(parents=True, exist_ok=True)
    (folder / name).write_bytes(data)


def block(values, per_line, form):
    rows = [values[i : i + per_line] for i in range(0, len(values), per_line)]
    return "".join("".join(form % v for v in row) + "\n" for row in rows)


def peer():
    values = block([a / 1000 for a in A], 5, "%15.7E")
    head = "PEER NGA STRONG MOTION DATABASE RECORD\nA Quake, 1/2/2003, A Town, 090\n"
    head += "ACCELERATION TIME SERIES IN UNITS OF G\n"
    put("at2", "nga2.at2", head + "NPTS=  %d, DT=   .0050 SEC,\n" % N + values)
    put("at2", "nga1.at2", head + "%d    0.0050    NPTS, DT\n" % N + values)
    put("at2", "crlf.at2", (head + "NPTS= %d, DT= .00500 SEC\n" % N + values).replace("\n", "\r\n"))


def columns():
    rows = [(0.01 * i, a / 100) for i, a in enumerate(A)]
    put("columns", "comma.csv", "time [s],a [g],b [g]\n" + "".join("%.2f,%.5f,%.3f\n" % (t, a, -a) for t, a in rows))
    semicolon = "t (ms);acc (m/s2)\n" + "".join("%.1f;%.4f\n" % (1000 * t, a) for t, a in rows)
    put("columns", "semicolon.csv", semicolon.replace(".", ","))
    put("columns", "blanks.txt", "Some prose\nTime[s]\tAccel[g]\n" + "".join("%.4f\t%.4f\n" % row for row in rows))
    put("columns", "series.txt", "%d 0.01\n" % N + block([a for _, a in rows], 8, "%9.4f"))
    put("columns", "comments.txt", "# units=cm/s2 dt=0.02\n" + "".join("%.4f\n" % a for a in A))
    uneven = "".join("%.3f,%.4f\n" % pair for pair in zip([0, 0.02, 0.035, 0.05, 0.09, 0.11], A))
    put("columns", "uneven.csv", "time [s],a [cm/s2]\n" + uneven)
    put("columns", "one.txt", "".join("%+.6e\n" % a for a in A) + "\n")


def smc():
    text = "2 CORRECTED ACCELEROGRAM\n*\nABC0A\n     1989  10  18    0004 Somewhere\nMoment Mag=      7.1\n"
    text += "station = A Town, 12 Main St, F  component=    S16W\n*\n*\n*\n*\n*\n"
    integers = [-32768] * 48
    integers[15], integers[16] = 1, N
    reals = [1.7e38] * 50
    reals[1] = 200.0
    values = "".join(
        "".join(("%10.3E" % v).replace("E+0", "E+").replace("E-0", "E-").rjust(10) for v in A[i : i + 8]) + "\n"
        for i in range(0, N, 8)
    )
    put("smc", "corrected.smc", text + block(integers, 8, "%10d") + block(reals, 5, "%15.7E") + "|  a comment\n" + values)


def japan():
    def file(direction, rate, offset):
        counts = [round(offset + 50 * a) for a in A] * 5
        head = [
            ("Origin Time", "2006/01/18 23:25:00"),
            ("Lat.", "37.798"),
            ("Long.", "142.200"),
            ("Depth. (km)", "36"),
            ("Mag.", "5.7"),
            ("Station Code", "ABC001"),
            ("Station Lat.", "38.7262"),
            ("Station Long.", "141.5109"),
            ("Station Height(m)", "-9999"),
            ("Record Time", "2006/01/18 23:25:46"),
            ("Sampling Freq(Hz)", "%dHz" % rate),
            ("Duration Time(s)", "%g" % (len(counts) / rate)),
            ("Dir.", direction),
            ("Scale Factor", "3920(gal)/6182761"),
            ("Max. Acc. (gal)", "2.000"),
            ("Last Correction", "2006/01/18 23:25:31"),
            ("Memo.", ""),
        ]
        return "".join("%-18s%s\n" % line for line in head) + block(counts, 8, "%8d ")

    put("knet", "surface.NS", file("N-S", 100, 8000))
    put("knet", "borehole.UD1", file("3", 200, -20000))


def taiwan():
    quake = "#Earthquake Information\n#Origin Time(GMT+08): 2018/02/06-23:50:42\n#Depth(km): 10.0\n#Station Information\n"
    head = "#StationCode: ABC\n#RecordLength(sec):    0.200\n#SampleRate(Hz): 200\n"
    head += "#AmplitudeUnit:  gal. DCoffset(corr)\n#AmplitudeMAX. U:   65.000~  -60.000\n"
    head += "#DataSequence: Time U(+); N(+); E(+)\n#Data: 4F10.3\n"
    rows = "".join("%10.3f%10.3f%10.3f%10.3f\n" % (0.005 * i, a, -10 * a, 0.5 * a) for i, a in enumerate(A))
    put("cwa", "quake.txt", quake + head + rows)
    put("cwa", "station.txt", head + rows)


def mexico():
    text = "\n" * 6 + "       ARCHIVO ESTANDAR DE ACELERACION\n"
    for name, value in [
        ("NOMBRE DE LA ESTACION", "UNA ESTACI\u00d3N"),
        ("CLAVE DE LA ESTACION", "UNES"),
        ("NUMERO DE CANALES", "3"),
        ("ORIENTACION C1-C6 (rumbo;orientacion)", "/N00E;+/V;+/N90W;-/"),
        ("INTERVALO DE MUESTREO, C1-C6 (s)", "/0.010/0.010/0.010/"),
        ("DURACION DEL REGISTRO (s), C1-C6", "/0.40/0.40/0.40/"),
        ("NUM. TOTAL DE MUESTRAS, C1-C6", "/%d/%d/%d/" % (N, N, N)),
        ("ACEL. MAX.(Gal), C1-C6", "/66.00/-66.00/33.00/"),
        ("UNIDADES DE LOS DATOS", "Gal (cm/s/s)"),
        ("FACTOR DE DECIMACION", "1"),
        ("FORMATO DATOS", "3F10.3"),
    ]:
        text += "%-40s: %s\n" % (name, value)
    text += "DATOS DE ACELERACION:\n   CANAL-1   CANAL-2   CANAL-3\n      N00E         V      E--W\n" + "-" * 30 + "\n"
    put("unam", "three.asa", text + "".join("%10.3f%10.3f%10.3f\n" % (a, -a, a / 2) for a in A))


def cosmos():
    def channel(number, azimuth):
        text = "Corrected acceleration   (Format v01.20 with 13 text lines) Src: 052n0001\n"
        text += "A Quake                                Jan 02, 2003\n" + "A line of text\n" * 2
        text += "Station 1234   A Town\n" + "A line of text\n" * 3
        text += "Chan %d:%4d Deg  A Town\n" % (number, azimuth)
        text += "Raw record length =   0.400 sec\nProcessed 01/02/03 by nobody\n"
        text += "Record filtered below  0.10 Hz (periods over  10.0 secs)\n"
        text += "Values used when parameter or data value is unknown/unspecified:   -999, -999.0\n"
        integers = [-999] * 100
        integers[0], integers[1], integers[53], integers[49] = 1, 4, azimuth, number
        text += " 100 Integer-header values follow on  10 lines, Format=    (10I8)\n" + block(integers, 10, "%8d")
        reals = [-999.0] * 100
        reals[33], reals[61], reals[63] = 10.0, 10.0, 66.0
        text += " 100 Real-header values follow on  20 lines, Format=    (5F15.6)\n" + block(reals, 5, "%15.6f")
        text += "   0 Comment lines follow\n"
        text += "%8d acceleration pts, approx   0 secs, units=cm/s2 (04), Format=(8F10.3)\n" % N
        return text + block(A, 8, "%10.3f") + "End-of-data for Chan%3d acceleration\n" % number

    put("cosmos", "corrected.v2c", channel(1, 90))


def volume_one(head, units, points, body, reals=50):
    """A channel of volume I: 13 lines of text, 16I5 with the number of points as number 28, 8F10.3, the points."""
    integers = [0] * 100
    integers[27] = points
    text = head + ["A line of text"] * (12 - len(head)) + [units]
    return "\n".join(text) + "\n" + block(integers, 16, "%5d") + block([0.01] * reals, 8, "%10.3f") + body


def volume_two(head, name, title, ends):
    """A channel of volume II: 25 lines of text, headers, and the three series, each below its title."""
    text = head + ["STATION NO. 12345", "A Town", name] + ["A line of text"] * (22 - len(head))
    text = "\n".join(text) + "\n" + block([0] * 100, 16, "%5d") + block([0.01] * 100, 8, "%10.3f")
    for quantity, unit in [("ACCEL", "CM/SEC/SEC"), ("VELOC", "CM/SEC"), ("DISPL", "CM")]:
        text += title % (16, quantity, unit) + block(A[:16], 8, "%10.3f")
    return text + ends


PAIRS = [(0.001 * t, a / 10) for t, a in zip([0, 20, 35, 50, 90, 110, 125, 150, 170, 185, 205, 230], A)]


def california():
    title = "%5d POINTS OF %s DATA EQUALLY SPACED AT  .010 SEC.  (UNITS: %s)  (8F10.3)\n"
    head = ["CORRECTED ACCELEROGRAM   99999", "UNCORRECTED ACCELEROGRAM DATA"]
    put("csmip_v2", "corrected.v2", volume_two(head, "CHAN  1:  90 DEG", title, "/&      END OF DATA FOR CHANNEL 1\n"))
    pairs = "".join("%7.3f%7.3f" % pair + ("\n" if i % 5 == 4 else "") for i, pair in enumerate(PAIRS)) + "\n"
    head = ["UNCORRECTED ACCELEROGRAM DATA", "A QUAKE", "STATION NO. 12345", "A Town   CSMIP", "CHAN  1:  90 DEG"]
    count = ["NO. OF POINTS = %d" % len(PAIRS)]
    units = "UNITS OF UNCOR ACCEL ARE SEC AND G/10"
    channel = volume_one(head + count, units, len(PAIRS), pairs + "/&  END OF DATA FOR CHANNEL 1\n")
    put("csmip", "pairs.v1", channel + channel.replace("CHAN  1:  90", "CHAN  2:  UP"))
    values = "%5d Accelerogram points, equally spaced at 0.010 sec, in g. Format: (8f9.6)\n" % N
    values += block([a / 1000 for a in A], 8, "%9.6f") + "/&      End of data for channel 1\n"
    put("csmip", "uncorrected.v1", volume_one(head, "Units are sec and g", N, values))
    chile = ["UNCORRECTED ACCELEROGRAM DATA", "UNIVERSIDAD DE CHILE - RENADIC", "STATION NO. 1", "VI\u00d1A", "CHAN  1: EW"]
    put("csmip", "renadic.v1", volume_one(chile + count, units, len(PAIRS), pairs + "/&  END OF DATA\n"))
    numbered = "%-72s%d"
    first = [
        "CORRECTED ACCELEROGRAM  IIBB127  94.610.0 COMP N08W   FILE   0  CORRESPONDING T",
        "FILE     0 OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:",
        numbered % ("A QUAKE", 7),
    ]
    title = "%5d POINTS OF %s DATA EQUALLY SPACED AT   .020 SEC.  IN UNITS %s\n"
    put("usc", "corrected.v2", volume_two(first, "COMP N08W", title, ""))
    head = ["FILE     0 OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:", "STATION USC# 0061", "A STATION", "COMP N08W"]
    put("usc", "uncorrected.v1", volume_one(head + count, "UNITS ARE SEC AND G/10", len(PAIRS), pairs + "/& END\n"))


def new_zealand():
    def component(title, name):
        text = title + " accelerogram 20030102_ABCD GNS Science\nSite ABCD      38 00 00S  176 00 00E\nA Town\n"
        text += "Instrument\nResolution\n" + "A line of text\n" * 7 + "Component %s\n" % name + "A line of text\n" * 3
        integers = [2003] * 40
        integers[30], integers[33] = N, N
        integers[34] = integers[35] = 10 if title == "Corrected" else 0
        reals = [0.0] * 60
        reals[7], reals[24], reals[25] = 1.0, 0.005, 0.02
        text += block(integers, 10, "%8d") + block(reals, 10, "%8.3f") + block(A, 10, "%8.1f")
        return text + (block(A[:10], 10, "%8.1f") * 2 if title == "Corrected" else "")

    put("geonet", "corrected.v2a", component("Corrected", "N00E") + component("Corrected", "Up"))
    put("geonet", "uncorrected.v1a", component("Uncorrected", "S16W"))


def europe():
    keys = [
        ("EVENT_NAME", ""),
        ("EVENT_DATE_YYYYMMDD", "20030102"),
        ("NETWORK", "XX"),
        ("STATION_CODE", "ABC"),
        ("STATION_NAME", "A Town"),
        ("SAMPLING_INTERVAL_S", "0.005000"),
        ("NDATA", str(N)),
        ("DURATION_S", "0.195000"),
        ("STREAM", "HNE"),
        ("UNITS", "cm/s^2"),
        ("PGA_CM/S^2", "66.000000"),
        ("TIME_PGA_S", "0.015000"),
        ("BASELINE_CORRECTION", "BASELINE NOT REMOVED"),
        ("DATA_TYPE", "ACCELERATION"),
        ("FILTER_TYPE", ""),
        ("HEADER_FORMAT", "DYNA 1.2"),
    ]
    lines = ["%s: %s" % key for key in keys] + ["USER%d: " % i for i in range(1, 49)]
    put("esm", "dyna.asc", "\n".join(lines) + "\n" + "".join("%.6f\n" % a for a in A))
    # AFAD's has fewer keys, and the count and the step in another order.
    keys = ["NDATA: %d" % N, "SAMPLING_INTERVAL_S: 0.01", "STATION_CODE: 1210", "STREAM: E", "UNITS: cm/s^2"]
    keys += ["DATA_TYPE: UNPROCESSED ACCELERATION", "USER1: "]
    put("esm", "afad.asc", "\n".join(keys) + "\n" + "".join("%.6f\n" % a for a in A))
    turkey = "STRONG GROUND MOTION RECORDS OF TURKIYE\r\nPLACE                        : \xdd\xdd\r\n"
    turkey += "SAMPLING INTERVAL (sec)      : 0.01\r\nNUMBER OF DATA               : %d\r\n" % N
    turkey += "PGA VALUES (gal)             : (N-S) 66.0 (E-W) 66.0 (U-D) 33.0\r\n\r\n   N-S   E-W   U-D\r\n"
    put("nsmn", "old.txt", turkey + "".join("%12.6f%12.6f%12.6f\r\n" % (a, -a, a / 2) for a in A))
    etabs = "TABLE:  Joint Accelerations - Absolute\nStory,Label,Output Case,Step Type,Time,UX,UY\n,,,,Sec,m/sec2,m/sec2\n"
    rows = "".join("Story%d,5,TH,Step By Step,%.2f,%.6f,%.6f\n" % (k, i / 100, a / 100, -a / 100) for k in (2, 1) for i, a in enumerate(A))
    put("long_table", "etabs.csv", etabs + rows)
    sigma = "Event Date & Time             : 2003-01-02 03:04:05\nStation Code / Name           : 1 / A Town\n"
    sigma += "Network                       : XX\nOrientation                   : NS\nProcessing Info               : x\n"
    sigma += "Time Increment (s)            : 0.005\nNumber of Data                : %d\n" % N
    sigma += "PGA (m/s/s)                   : 6.6E-01\nAccelaration time series in m/s/s\n"
    put("sigma", "fused.cor.acc", sigma + block([a / 100 for a in A], 5, "%14.7E"))


def iran():
    def component(name):
        text = "* VOL1DS FILE : 6013-1  /02\nINSTRUMENT TYPE = SSA-2\nNO 123\n\n %s\n\nCOMP %s\n" % (name, name)
        text += "A Town Station: 36.78N 49.40E   87 m, L= 355 T=  85\n1990/06/20 21:00:08\n"
        text += "PERIOD = 0.02 DAMPING = 0.60\nNO OF POINTS = %d  DURATION = 0.200 SEC\nUNITS ARE SEC AND G/10\nEND\n" % N
        text += "    1    2    3\n" * 7 + "     1.500     2.500\n" * 7
        return text + block([a / 100 for a in A], 10, "%13.5E") + "-END OF RECORD-\n"

    put("bhrc", "vol1.v1", component("L") + component("V"))


def crc32c(data):
    crc = 0xFFFFFFFF
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ (0x82F63B78 if crc & 1 else 0)
    return crc ^ 0xFFFFFFFF


def mini_seed():
    def record(encoding, data, count, first=b"000001D "):
        head = first + b"ABC  " + b"  " + b"HNE" + b"XX" + struct.pack(">HHBBBBH", 2003, 2, 3, 4, 5, 0, 0)
        head += struct.pack(">HhhBBBBiHH", count, 100, 1, 0, 0, 0, 1, 0, 64, 48)
        head += struct.pack(">HHBBBB", 1000, 0, encoding, 1, 9, 0)
        return (head.ljust(64, b"\0") + data).ljust(512, b"\0")

    counts = [round(50 * a) for a in A]
    put("mseed", "int32.mseed", record(3, struct.pack(">%di" % N, *counts), N))
    # Steim-1, four differences of one byte a word; the first of a record is not used.
    small = [0]
    for i in range(1, 52):
        small.append(small[-1] + (i * 7) % 11 - 5)
    steps = [0] + [b - a for a, b in zip(small, small[1:])]
    words = [struct.pack(">4b", *steps[i : i + 4]) for i in range(0, 52, 4)]
    # Two bits for each of the frame's 16 words: 1 for the 13 behind the control word and the two end values.
    control = sum(1 << (30 - 2 * word) for word in range(3, 16))
    frame = struct.pack(">Iii", control, small[0], small[-1]) + b"".join(words)
    put("mseed", "steim1.mseed", record(10, frame, len(small)))
    put("mseed", "two.mseed", record(1, struct.pack(">%dh" % N, *counts), N) * 2)
    # Version 3 (FDSN): little-endian but for Steim's frames, with a checksum.
    for encoding, data, count, name in [(3, struct.pack("<%di" % N, *counts), N, "three"), (10, frame, 52, "three_steim")]:
        source = b"FDSN:XX_ABC__H_N_E"
        head = b"MS" + struct.pack("<BBIHHBBBBdI", 3, 0, 0, 2003, 2, 3, 4, 5, encoding, 100.0, count)
        tail = struct.pack("<BBHI", 1, len(source), 0, len(data)) + source + data
        crc = crc32c(head + bytes(4) + tail)
        put("mseed", name + ".mseed", head + struct.pack("<I", crc) + tail)


def sac():
    for order, name in [("<", "little.sac"), (">", "big.sac")]:
        reals = [-12345.0] * 70
        reals[0], reals[5], reals[6], reals[57], reals[58] = 0.01, 0.0, 0.01 * (N - 1), 90.0, 90.0
        integers = [-12345] * 40
        integers[6], integers[9], integers[15], integers[35] = 6, N, 1, 1
        integers[16] = 8
        texts = b"ABC     " + b"-12345          " + b"-12345  " * 17 + b"HNE     " + b"XX      " + b"-12345  " * 2
        head = struct.pack(order + "70f", *reals) + struct.pack(order + "40i", *integers) + texts.ljust(192, b" ")[:192]
        put("sac", name, head + struct.pack(order + "%df" % N, *A))


def station_xml():
    put(
        "station_xml",
        "one.xml",
        """<?xml version="1.0" encoding="UTF-8"?>
<FDSNStationXML xmlns="http://www.fdsn.org/xml/station/1" schemaVersion="1.1"><Source>x</Source>
<Network code="XX"><Station code="ABC"><Site><Name>A Town</Name></Site>
<Channel code="HNE" locationCode="" startDate="2000-01-01T00:00:00" endDate="2999-01-01T00:00:00">
<Azimuth>90</Azimuth><Dip>0</Dip><SampleRate>100</SampleRate>
<Response><InstrumentSensitivity><Value>213945.0</Value><Frequency>1.0</Frequency>
<InputUnits><Name>M/S**2</Name></InputUnits><OutputUnits><Name>COUNTS</Name></OutputUnits>
</InstrumentSensitivity></Response></Channel></Station></Network></FDSNStationXML>
""",
    )


def ours():
    for name, text in [
        ("mean", "mean"),
        ("pre_event", "pre-event:5s"),
        ("poly", "poly:4"),
        ("graizer", "graizer:2:500 ms"),
        ("boore", "boore:10s:25s"),
        ("target", "0.4 g at 1.2 s"),
        ("damping", "3 m/s2 at 800 ms, 2 %"),
        ("target_source", "target.csv, 0.1 s to 2 s, 2 %"),
        ("spectrum", "period_s,psa_g,sa_g,damping_ratio\n0.5,0.3,0.31,0.02\n1,0.2,0.21,0.02\n"),
    ]:
        put("processing", name, text)
    put("quantity", "one", "2.3 m")
    put("quantity", "grid", "0.3 m:4 m:64")
    put("quantity", "list", "200 mm, 40 cm, 1.5e-3km")
    put("quantity", "ratio", "5 %")
    put("quantity", "inertia", "12 kg*m2")
    put(
        "study_toml",
        "synthetic.toml",
        """[ground]
code = "as1170.4"
edition = 2007
hazard_factor = 0.08
site = "De"
return_period_years = 500
count = 2
seed = 3
[objects]
heights = "0.5 m"
thicknesses_m = [0.2, 0.4]
tolerance = "5 g"
friction = 0.5
""",
    )
    put(
        "study_toml",
        "small.toml",
        """[ground]
motions = ["a.AT2"]
unit = "g"
scale = 1.5
[building]
storeys = 12
storey_height = "3 m"
damping = "5 %"
levels = [{ name = "roof", level_ratio = 1.0 }]
[objects]
mass = "150 kg"
stiffness = "4380 N/mm"
heights = "0.3 m:4 m:4"
thicknesses = "200 mm, 400 mm"
restitution = "housner"
[outputs]
figures = false
""",
    )


def inventory():
    rows = [
        ["id", "item", "level_ratio", "height [mm]", "depth (cm)", "mass", "friction", "LS", "maker"],
        ["a", "rack", "0.5", "1800", "60", "140 kg", "0.3-0.5", "H", "'=1+1"],
        ["b", 'cabinet, 19"', "50 %", "", "45", "", "", "low", ""],
    ]
    quoted = [['"' + cell.replace('"', '""') + '"' if "," in cell else cell for cell in row] for row in rows]
    put("inventory_csv", "comma.csv", "".join(",".join(row) + "\n" for row in quoted))
    put("inventory_csv", "semicolon.csv", "".join(";".join(row).replace("0.", "0,") + "\r\n" for row in rows))
    put("inventory_csv", "utf16.csv", "\n".join("\t".join(row) for row in rows).encode("utf-16"))
    put("inventory_csv", "form.csv", "Register\n,,,,\nitem,height,depth,level_ratio\nunits,mm,cm,-\nrack,1800,60,1\nTotal,,,\n")
    xml = ""
    for n, row in enumerate(rows, 1):
        cells = "".join(
            f'<c r="{chr(65 + i)}{n}"><v>{cell}</v></c>'
            if cell.isdigit()
            else f'<c r="{chr(65 + i)}{n}" t="inlineStr"><is><t>{cell}</t></is></c>'
            for i, cell in enumerate(row)
        )
        xml += f'<row r="{n}">{cells}</row>'
    merge = '<mergeCells count="1"><mergeCell ref="I2:I3"/></mergeCells>'
    put("inventory_xlsx", "plain.xml", f"<worksheet><sheetData>{xml}</sheetData></worksheet>")
    odd = xml.replace("<v>1800</v>", "<f>900*2</f><v>1800</v>").replace("<v>60</v>", "<f>60</f>")
    put("inventory_xlsx", "formulas.xml", f'<worksheet><dimension ref="A1:I3"/><sheetData>{odd}</sheetData>{merge}</worksheet>')


def hazard():
    engine = "#,,,,\"generated_by='OpenQuake engine 3.26.2', kind='mean', investigation_time=50.0, imt='PGA'\"\n"
    put("hazard", "curves_openquake.csv", engine + "lon,lat,depth,poe-0.1,poe-0.2,poe-0.4\n10.0,45.0,0.0,0.5,0.1,0.01\n11.0,45.0,0.0,0.4,0.1,0\n")
    spectra = "lon,lat,0.1~PGA,0.1~SA(0.2),0.02~PGA,0.02~SA(0.2)\n10.0,45.0,0.16,0.33,0.37,0.77\n"
    put("hazard", "spectra_openquake.csv", engine.replace(", imt='PGA'", "") + spectra)
    put("hazard", "map_openquake.csv", engine.replace(", imt='PGA'", "") + "lon,lat,PGA-0.1,SA(0.2)-0.1\n10.0,45.0,0.16,0.33\n")
    put("hazard", "one_map_openquake.csv", "#,,,\"generated_by='OpenQuake engine 3.26.2'\"\nlon,lat,PGA,SA(0.2)\n10.0,45.0,0.16,0.33\n")
    put("hazard", "aelo.csv", "#,,\"investigation_time=50.0\"\n,poe-0.02,poe-0.1\nPGA,0.5,0.25\nSA(0.2),1,0.5\n")
    put("hazard", "curves_nshmp.csv", "name,lon,lat,0.005,0.05,0.5\nA Town,10.0,45.0,0.4,0.05,0.001\n")
    curve = '{"response":[{"metadata":{"imt":{"value":"PGA"},"xvals":[0.1,0.5,1]},"data":[{"component":"Total","yvals":[0.01,0.001,0.0001]}]}]}'
    put("hazard", "curves_usgs.json", curve)
    put("hazard", "design_usgs.json", '{"request":{"parameters":{"siteClass":"BC"}},"response":{"data":{"ss":1.5,"s1":0.6}}}')
    nrml = '<nrml xmlns="http://openquake.org/xmlns/nrml/0.5"><hazardCurves statistics="mean" IMT="PGA" investigationTime="50.0">'
    nrml += "<IMLs>0.1 0.2 0.4</IMLs><hazardCurve><Point><pos>10.0 45.0</pos></Point><poEs>0.5 0.1 0.01</poEs></hazardCurve></hazardCurves></nrml>"
    put("hazard", "curves_nrml.xml", nrml)
    levels = [("PGA", 0.2), ("Ss", 0.5), ("S1", 0.15)]
    heads = [f"{name}-DD{k}" for name, _ in levels for k in (1, 2, 3, 4)] + [f"PGV-DD{k}" for k in (4, 3, 2, 1)]
    values = ["%.3f" % (x / k) for _, x in levels for k in (1, 2, 3, 4)] + ["5.0", "7.0", "20.0", "40.0"]
    put("hazard", "afad.csv", ",".join(["LON", "LAT", *heads]) + "\n" + ",".join(["10.0", "45.0", *values]) + "\n")
    years = [30, 50, 72, 101, 140, 201, 475, 975, 2475]
    heads = [f"T{t}{name}" for t in years for name in ("ag", "F0", "Tc")]
    values = [value for k in range(9) for value in ("%.2f" % (0.3 * (k + 1)), "2.5", "0.3")]
    put("hazard", "ntc.csv", ",".join(["ID", "LON", "LAT", *heads]) + "\n" + ",".join(["1", "10.0", "45.0", *values]) + "\n")


for write in [hazard, peer, columns, smc, japan, taiwan, mexico, cosmos, california, new_zealand, europe, iran, mini_seed, sac]:
    write()
station_xml()
ours()
inventory()
