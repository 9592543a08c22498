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


def california():
    integers = [0] * 100
    reals = block([0.01] * 100, 8, "%10.3f")
    text = "Corrected accelerogram       CSMIP Strong Motion\nUncorrected accelerogram\n" + "A line of text\n" * 4
    text += "Station No. 12345\nChan  1:  90 Deg\n" + "A line of text\n" * 17
    text += block(integers[:100], 16, "%5d") + reals
    for quantity, unit in [("acceleration", "cm/sec2"), ("velocity", "cm/sec"), ("displacement", "cm")]:
        text += "%5d points of %s data equally spaced at  .010 sec, in %s. (8F10.3)\n" % (16, quantity, unit)
        text += block(A[:16], 8, "%10.3f")
    put("csmip", "corrected.v2", text + "/&      End-of-data for Chan  1\n")
    text = "Uncorrected Accelerogram Data       CSMIP\n" + "A line of text\n" * 7 + "Chan  1:  90 Deg\n"
    text += "A line of text\n" * 2 + "Units are sec and g\n" + "A line of text\n"
    text += block([0] * 100, 16, "%5d") + block([0.01] * 50, 8, "%10.3f")
    text += "%5d Accelerogram points, in g, at 0.010 sec. Format: (8f9.6)\n" % N
    put("csmip", "uncorrected.v1", text + block([a / 1000 for a in A], 8, "%9.6f") + "/&      End\n")


def new_zealand():
    text = "Corrected accelerogram                  GNS Science\nSite ABCD                38 00 00S 176 00 00E\n"
    text += "A Town\nInstrument\nResolution\n" + "A line of text\n" * 7 + "Component N00E\n" + "A line of text\n" * 3
    integers = [0] * 40
    integers[30:36] = [N, 0, 0, N, N, N]
    reals = [0.0] * 60
    reals[25] = 0.02
    text += block(integers, 10, "%8d") + block(reals, 10, "%8.3f")
    put("geonet", "corrected.v2a", text + block(A, 10, "%8.1f") * 3)


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
    turkey = "STRONG GROUND MOTION RECORDS OF TURKIYE\r\nPLACE                        : \xdd\xdd\r\n"
    turkey += "SAMPLING INTERVAL (sec)      : 0.01\r\nNUMBER OF DATA               : %d\r\n" % N
    turkey += "PGA VALUES (gal)             : (N-S) 66.0 (E-W) 66.0 (U-D) 33.0\r\n\r\n   N-S   E-W   U-D\r\n"
    put("nsmn", "old.txt", turkey + "".join("%12.6f%12.6f%12.6f\r\n" % (a, -a, a / 2) for a in A))
    sigma = "Event Date & Time : 2003-01-02 03:04:05\n" + "A line: of text\n" * 6
    sigma += "Time step (s): 0.005\nNumber of points: %d\nUnits: m/s2\n" % N
    put("sigma", "fused.cor.acc", sigma + block([a / 100 for a in A], 5, "%14.7E"))


def others():
    text = "CORRECTED ACCELEROGRAM IIB001     94.001.0      COMP N08W   FILE 1\n" + "A line of text\n" * 24
    text += block([0] * 100, 16, "%5d") + block([0.01] * 100, 8, "%10.3f")
    text += "%5d POINTS OF ACC DATA EQUALLY SPACED AT  .020 SEC. IN UNITS CM/SEC/SEC\n" % N
    put("usc", "corrected.s0a", text + block(A, 8, "%10.3f"))
    text = "* VOL1DS FILE\nCOMP L  N45E\nLENGTH OF RECORD = 0.4 SEC\nNUMBER OF DATA POINTS = %d\n" % N
    put("bhrc", "vol1.v1", text + "UNIT G/10\n" + "A line of text\n" * 10 + block([a / 100 for a in A], 10, "%13.5E"))


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


for write in [peer, columns, smc, japan, taiwan, mexico, cosmos, california, new_zealand, europe, others, mini_seed, sac]:
    write()
station_xml()
ours()
