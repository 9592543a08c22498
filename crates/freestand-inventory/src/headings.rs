//! What a heading means: one table of names in six languages, and the unit that may follow.

use std::collections::HashMap;
use std::sync::LazyLock;

use freestand_input::quantity::{Dimension, lookup};
use freestand_input::words::canonical;

use super::columns::{COLUMNS, Column, Holds};
use super::more_headings::MORE_HEADINGS;
use super::numbers::plain;
use super::units::{CellUnit, NoUnit, find};
use super::vocabulary::is_among;

/// The headings of a column beside its name: English, German, French, Spanish, Italian, Japanese; `|` between two.
/// Of two columns with headings of one name, the earlier in the list is read. `=` and a unit after
/// a heading: it states its unit.
#[rustfmt::skip]
const HEADINGS: &[(Column, &[&str])] = &[
    (Column::Id, &["id|asset no|asset number|asset id|asset|asset tag|tag|tag no|tag number|equip id|equipment id|equip no|equipment no|equipment number|\
                   object id|object no|item no|item number|item id|ref|ref no|reference|barcode|serial|serial no|serial number|code|inventory no|\
                   inventory number|inv no|no|number|num",
        "Inv.-Nr.|Inventarnummer|Inventar-Nr.|Gerätenummer|Geräte-Nr.|Objektnummer|Kennung|Kennzeichen|Nr.|Nummer|lfd. Nr.|Pos.|Pos.-Nr.",
        "N° d'inventaire|N° inventaire|numéro d'inventaire|référence|réf.|repère|N°|numéro", "código|nº de inventario|número de inventario|referencia|nº|núm.",
        "matricola|codice|numero inventario|n. inventario|n.", "管理番号|番号|資産番号|備品番号"]),
    (Column::Item, &["item|nonstructural item|nonstructural component|description|component|object|name|equipment|item description|equipment description|\
                     asset description|equipment name|item name|asset name|object name|article",
        "Bezeichnung|Gegenstand|Objekt|Gerät|Gerätebezeichnung|Benennung|Beschreibung", "désignation|objet|équipement|description|nom|libellé|appareil",
        "equipo|descripción|objeto|elemento|nombre|denominación", "descrizione|oggetto|apparecchio|attrezzatura|denominazione|nome",
        "品名|名称|機器名|品目|設備名"]),
    (Column::Quantity, &["quantity|qty|qty.|count|no. off|no of|no. of|number of|number of items|no. of items|pcs|pieces|units|quant",
        "Anzahl|Stück|Menge|Stückzahl|Stk.", "quantité|qté|nombre", "cantidad|cant.|uds.|unidades", "q.tà|quantità|qtà", "数量|個数|台数"]),
    (Column::Priority, &["priority|prio", "Priorität", "priorité", "prioridad", "priorità", "優先度|優先順位"]),
    (Column::Location, &["location|area|zone|department|dept", "Bereich|Abteilung|Standort|Ort", "lieu|emplacement|secteur|service",
        "ubicación|zona|lugar", "ubicazione|posizione|reparto", "場所|設置場所|区域"]),
    (Column::Building, &["building|block|bldg|building name", "Gebäude|Haus", "bâtiment|bât.", "edificio", "edificio", "建物|棟"]),
    (Column::Floor, &["floor|level|storey|story|floor level|floor no|floor number|floor name|building level",
        "Etage|Geschoss|Geschoß|Stockwerk|Stock", "étage|niveau", "planta|piso|nivel", "piano|livello", "階|階数|フロア"]),
    (Column::Room, &["room|room no|room number|room name|rm", "Raum|Zimmer|Raum-Nr.|Raumnummer", "salle|pièce|local|chambre", "sala|habitación|local",
        "stanza|sala|locale", "部屋|室名|室"]),
    (Column::LifeSafety, &["life safety|LS|life safety LS|consequence to life|life safety risk|life risk", "Personengefährdung|Lebensgefahr",
        "sécurité des personnes", "seguridad de vida|seguridad de las personas", "sicurezza delle persone", "人命安全"]),
    (Column::Property, &["property|property loss|PL|property loss PL|consequence to property|property risk", "Sachschaden", "dommages matériels|perte matérielle",
        "daños materiales|pérdida material", "danni materiali", "財産損失"]),
    (Column::Function, &["function|functional loss|function loss|FL|functional loss FL|consequence to function|functional risk|loss of function", "Funktionsausfall",
        "perte de fonction", "pérdida funcional|pérdida de función", "perdita di funzione", "機能損失"]),
    (Column::Height, &["height|ht|h|hgt|overall height|total height|height overall", "Höhe|Hoehe|Gesamthöhe", "hauteur|haut.", "alto|altura|alt.", "altezza",
        "高さ|高"]),
    (Column::Thickness, &["thickness|depth|d|dpt|overall depth|short side|depth overall", "Tiefe", "profondeur|prof.|épaisseur",
        "fondo|profundidad|prof.", "profondità|prof.", "奥行|奥行き|厚さ"]),
    (Column::Width, &["width|w|wd|overall width|width overall|length|l|len|long side", "Breite|Länge|Laenge", "largeur|larg.|longueur|long.",
        "ancho|anchura|largo|longitud", "larghezza|lunghezza", "幅|横幅|長さ"]),
    (Column::BaseThickness, &["base_thickness|base thickness|base depth|foot spacing|feet spacing|foot spacing depth", "Fußabstand|Standtiefe|Basistiefe",
        "profondeur de base|écartement des pieds", "fondo de base|separación de patas", "profondità base|interasse piedini", "脚間隔"]),
    (Column::BaseWidth, &["base_width|base width|foot spacing width", "Standbreite|Basisbreite", "largeur de base", "ancho de base", "larghezza base"]),
    (Column::CgHeight, &["cg_height|cg height|c.g. height|c.g.|cg|cog|height of cg|height of c.g.|center of gravity|centre of gravity|center of gravity height|\
                         centre of gravity height|height of center of gravity|height of centre of gravity|cog height",
        "Schwerpunkthöhe|Schwerpunkt|Höhe Schwerpunkt|Höhe des Schwerpunkts", "centre de gravité|hauteur du centre de gravité|hauteur cdg|cdg",
        "centro de gravedad|altura del centro de gravedad|altura cdg", "baricentro|altezza baricentro|altezza del baricentro", "重心|重心高さ|重心高"]),
    (Column::Mass, &["mass|weight|wt|wgt|kg=kg|kgs=kg|lbs=lb|lb=lb|operating weight|operating mass|gross weight|gross mass|weight each|unit weight|unit mass|mass each",
        "Masse|Gewicht|Betriebsgewicht|Bruttogewicht|Einzelgewicht", "masse|poids|poids unitaire", "masa|peso|peso unitario", "massa|peso|peso unitario",
        "重量|質量"]),
    (Column::Stiffness, &["stiffness|edge stiffness|stiffness of edge", "Kantensteifigkeit|Steifigkeit", "raideur|rigidité", "rigidez", "rigidezza", "剛性"]),
    (Column::PadStiffness, &["pad_stiffness|pad stiffness|spring rate|foot stiffness", "Federrate|Federsteifigkeit|Fußsteifigkeit", "raideur du pied|raideur d'appui",
        "rigidez de pata|constante de resorte", "rigidezza piedino", "ばね定数"]),
    (Column::PadsPerEdge, &["pads_per_edge|pads per edge|feet per edge"]),
    (Column::Cushion, &["cushion|cushion entry"]),
    (Column::Tolerance, &["tolerance|fragility|max shock|maximum shock|shock limit|shock rating|shock|allowable g=g|max g=g|g rating=g|g limit=g|allowable acceleration|\
                          allowable shock|tolerable acceleration|peak tolerance",
        "Stoßfestigkeit|zulässige Beschleunigung|zulässiger Stoß|Schockfestigkeit", "choc admissible|accélération admissible|choc max",
        "choque admisible|aceleración admisible", "urto ammissibile|accelerazione ammissibile", "許容加速度|許容衝撃"]),
    (Column::ToleranceDuration, &["tolerance_duration|tolerance duration|tol duration|pulse|pulse duration|shock duration", "Stoßdauer|Pulsdauer", "durée du choc",
        "duración del choque", "durata dell'urto", "作用時間"]),
    (Column::Restitution, &["restitution|coefficient of restitution"]),
    (Column::Friction, &["friction|friction coefficient|coefficient of friction", "Reibung|Reibbeiwert", "frottement", "rozamiento", "attrito", "摩擦係数"]),
    (Column::Accepted, &["accepted|accepted probability"]),
    (Column::Questions, &["questions|question"]),
    (Column::Anchored, &["anchored|anchorage|anchor|restrained|restraint|bolted|fixed|secured|is anchored|fixing", "verankert|befestigt|Verankerung|Befestigung|gesichert",
        "fixé|fixé au mur|ancré|ancrage|fixation", "anclado|fijado|anclaje|fijación", "ancorato|fissato|ancoraggio|fissaggio", "固定|固定有無|転倒防止"]),
    (Column::RestsOn, &["rests_on|rests on|feet|foot positions|base|stands on|support|supports", "Füße|Untergrund|steht auf", "pieds|appui|repose sur",
        "patas|apoyo", "piedini|appoggio", "脚|脚部"]),
    (Column::WallGap, &["wall_gap|wall gap|gap to wall|distance to wall|distance from wall", "Wandabstand|Abstand zur Wand|Abstand von der Wand",
        "distance au mur|écart au mur", "distancia a la pared", "distanza dal muro|distanza dalla parete", "壁からの距離|壁との隙間"]),
    (Column::NeighbourGap, &["neighbour_gap|neighbour gap|neighbor gap|gap to neighbour|gap to neighbor", "Abstand zum Nachbarn", "écart au voisin", "distancia al vecino",
        "distanza dal vicino", "隣との隙間"]),
    (Column::WallHeight, &["wall_height|wall height", "Wandhöhe", "hauteur du mur", "altura de la pared", "altezza del muro"]),
    (Column::WallStiffness, &["wall_stiffness|wall stiffness", "Wandsteifigkeit"]),
    (Column::Casters, &["casters|castors|caster|castor|wheels|wheel|wheeled|on wheels|on castors|on casters|mobile",
        "Rollen|Räder|Lenkrollen|fahrbar", "roulettes|roues|sur roulettes", "ruedas|con ruedas", "ruote|rotelle", "キャスター|車輪"]),
    (Column::RollingResistance, &["rolling_resistance|rolling resistance", "Rollwiderstand", "résistance au roulement", "resistencia a la rodadura",
        "resistenza al rotolamento"]),
    (Column::Clearance, &["clearance|free distance|clear distance", "Freiraum|freier Weg", "dégagement|espace libre", "espacio libre", "spazio libero"]),
    (Column::Notes, &["notes|note|comments|comment|remarks|remark|photo|photos|photo no", "Bemerkung|Bemerkungen|Anmerkung|Hinweis|Foto",
        "observations|remarques|remarque|commentaire", "observaciones|notas|comentarios", "note|osservazioni|annotazioni", "備考|注記|写真"]),
    (Column::Dimensions, &["dimensions|dimension|dims|size|sizes|overall dimensions", "Maße|Abmessungen|Abmessung|Größe",
        "dimensions|encombrement|taille", "dimensiones|medidas|tamaño", "ingombro|dimensioni|misure", "寸法|外形寸法|サイズ"]),
    (Column::Shape, &["shape|form|base shape|shape of base", "Form|Grundform|Grundriss", "forme", "forma", "forma", "形|形状"]),
    (Column::Diameter, &["diameter|dia|diam|ø|base diameter|outer diameter|outside diameter", "Durchmesser|Außendurchmesser", "diamètre|diam.", "diámetro", "diametro", "直径|外径"]),
    (Column::Scan, &["scan|scan file|3d scan|mesh|mesh file", "3D-Scan|Scandatei", "scan 3d|fichier de scan", "escaneo|escaneo 3d", "scansione|scansione 3d",
        "スキャン|3dスキャン"]),
    (Column::ScanUnit, &["scan_unit|scan unit|mesh unit", "Scan-Einheit", "unité du scan", "unidad del escaneo", "unità della scansione", "スキャン単位"]),
    (Column::ScanBase, &["scan_base|scan base|scan underside"]),
    (Column::Unit, &["unit|uom|unit of measure|units of measure|unit of measurement|size unit|dimension unit|dimensions unit|length unit|weight unit|mass unit",
        "Einheit|Einheiten|Maßeinheit|Längeneinheit|ME", "unité|unités|unité de mesure", "unidad|unidad de medida", "unità|unità di misura|UM", "単位"]),
];

/// Headings of [`Column::Width`] for the longer side: with a width and without a depth, the width
/// is the shorter one.
const LONG_SIDES: &str =
    "length l len longside lange laenge longueur long largo longitud lunghezza 長さ";

/// Letters that are sizes only beside others of their kind: German and French headings.
const LETTERS: [(&str, Column); 4] = [
    ("b", Column::Width),
    ("t", Column::Thickness),
    ("p", Column::Thickness),
    ("a", Column::Height),
];

/// Words beside a name that do not change it.
const QUALIFIERS: &str = "overall approx approximate max maximum est estimated nominal external outside ca \
    total of the item object if known gesamt aussen max hors tout esterno exterior measured dim unit";

/// A language that headings are written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Language {
    English,
    /// German, French, Spanish, Italian, Turkish, Portuguese: numbers usually have a decimal comma.
    Comma,
    /// Japanese and Chinese: floor 1 is the ground.
    EastAsian,
    /// A mapping file says what it is.
    Unsaid,
}

/// A heading of the table.
#[derive(Debug, Clone, Copy)]
struct Entry {
    column: Column,
    /// Its place among the headings of its name in its language: the lower one is read.
    rank: u16,
    language: Language,
    unit: Option<&'static str>,
    is_long_side: bool,
}

fn squashed(text: &str) -> String {
    canonical(text).replace(' ', "")
}

static TABLE: LazyLock<HashMap<String, Vec<Entry>>> = LazyLock::new(|| {
    let mut table: HashMap<String, Vec<Entry>> = HashMap::new();
    use Language::{Comma, EastAsian, English};
    const LANGUAGES: [Language; 6] = [English, Comma, Comma, Comma, Comma, EastAsian];
    const MORE_LANGUAGES: [Language; 3] = [Comma, Comma, EastAsian];
    let first = HEADINGS
        .iter()
        .flat_map(|(column, texts)| texts.iter().zip(LANGUAGES).map(move |one| (column, one)));
    let more = MORE_HEADINGS.iter().flat_map(|(column, texts)| {
        texts
            .iter()
            .zip(MORE_LANGUAGES)
            .map(move |one| (column, one))
    });
    let own = COLUMNS
        .iter()
        .map(|spec| (&spec.column, (&spec.name, English)));
    for (column, (texts, language)) in first.chain(more).chain(own) {
        // Each language has its usual heading: "Inv.-Nr." is no worse than "Asset tag".
        for (rank, text) in (1..).zip(texts.split('|').filter(|text| !text.is_empty())) {
            let (name, unit) = text
                .split_once('=')
                .map_or((text, None), |(name, unit)| (name, Some(unit)));
            let key = squashed(name);
            let is_long_side = *column == Column::Width && is_among(&key, LONG_SIDES);
            let entries = table.entry(key).or_default();
            if !entries.iter().any(|entry| entry.column == *column) {
                entries.push(Entry {
                    column: *column,
                    rank,
                    language,
                    unit,
                    is_long_side,
                });
            }
        }
    }
    table
});

/// What a heading means.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Meaning {
    pub column: Column,
    /// Of two columns with one meaning, that with the lower rank is read.
    pub rank: u16,
    pub language: Language,
    pub unit: HeadingUnit,
    pub is_long_side: bool,
    /// The order of sizes in a heading such as `Dimensions (H x W x D)`.
    pub order: Option<Vec<char>>,
}

impl Meaning {
    /// A column of which nothing else is known.
    pub(super) fn new(column: Column) -> Self {
        Self {
            column,
            rank: 0,
            language: Language::English,
            unit: HeadingUnit::None,
            is_long_side: false,
            order: None,
        }
    }

    /// What a mapping file says.
    pub(super) fn mapped(column: Column, unit: Option<CellUnit>) -> Self {
        Self {
            unit: unit.map_or(HeadingUnit::None, HeadingUnit::Stated),
            ..Self::new(column)
        }
    }
}

/// The unit in a heading.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum HeadingUnit {
    /// None is stated.
    None,
    Stated(CellUnit),
    /// What is stated is not a unit of this column.
    Wrong(String),
}

impl HeadingUnit {
    /// The unit that is stated.
    pub(super) fn stated(&self) -> Option<CellUnit> {
        match self {
            Self::Stated(unit) => Some(*unit),
            Self::None | Self::Wrong(_) => None,
        }
    }

    /// Its symbol.
    pub(super) fn symbol(&self) -> Option<&'static str> {
        self.stated().map(CellUnit::symbol)
    }
}

/// Longest heading that is interpreted; known headings are far shorter.
const MAX_HEADING_BYTES: usize = 120;

/// What a heading means; `None`: it is not one of the table.
pub(super) fn meaning(text: &str) -> Option<Meaning> {
    if text.len() > MAX_HEADING_BYTES {
        return None;
    }
    let text = plain(text);
    let text = text.trim_end_matches([':', '*', '?', ' ']).trim();
    if text.is_empty() {
        return None;
    }
    if let Some(order) = order_of(bracketed(text).map_or(text, |(name, ..)| name)) {
        return Some(of_order(text, order));
    }
    whole(text).or_else(|| of_parts(text))
}

/// `H x W x D (mm)` alone: sizes in this order.
fn of_order(text: &str, order: Vec<char>) -> Meaning {
    let column = Column::Dimensions;
    let unit = match bracketed(text) {
        Some((_, inner, _)) => stated(inner, column),
        None => text
            .rsplit_once(' ')
            .map_or(HeadingUnit::None, |(_, last)| {
                find(last, Dimension::Length).map_or(HeadingUnit::None, HeadingUnit::Stated)
            }),
    };
    Meaning {
        rank: 50,
        unit,
        order: Some(order),
        ..Meaning::new(column)
    }
}

/// The meaning of a letter beside other sizes: `B`, `T` and `P` of German and French lists.
pub(super) fn letter_meaning(text: &str) -> Option<Meaning> {
    let text = plain(text);
    let (name, unit) = bracketed(&text).map_or((text.as_str(), ""), |(name, unit, _)| (name, unit));
    let letter = squashed(name);
    let (_, column) = LETTERS.iter().find(|(other, _)| *other == letter)?;
    Some(Meaning {
        rank: 90,
        language: Language::Comma,
        unit: stated(unit, *column),
        ..Meaning::new(*column)
    })
}

fn whole(text: &str) -> Option<Meaning> {
    if let Some(found) = named(text) {
        return Some(found);
    }
    if let Some((name, inner, after)) = bracketed(text)
        && let Some(mut found) = named(name)
            .or_else(|| named(&format!("{name} {after}")))
            .or_else(|| unqualified(name))
    {
        // "Area (m2)" is not a place, "Masse (mm)" not a mass but Swiss sizes.
        if dimension(found.column).is_none()
            && found.column != Column::Anchored
            && lookup(inner).is_some()
        {
            return None;
        }
        if is_another(&found, inner) || is_another(&found, after) {
            return None;
        }
        let is_length = find(inner, Dimension::Length).is_ok() || order_of(inner).is_some();
        if found.column == Column::Mass && is_length && squashed(name) == "masse" {
            found.column = Column::Dimensions;
        }
        if found.unit == HeadingUnit::None {
            found.unit = stated(inner, found.column);
            if found.unit == HeadingUnit::None && !after.is_empty() {
                found.unit = stated(after, found.column);
            }
        }
        found.order = order_of(inner).or_else(|| order_of(after)).or(found.order);
        return Some(found);
    }
    suffixed(text).or_else(|| unqualified(text))
}

/// `Höhe / Height`, `Item / Objet (mm)`: every part means the same, or is a unit.
fn of_parts(text: &str) -> Option<Meaning> {
    let parts: Vec<&str> = text
        .split(['/', '|', ';'])
        .map(str::trim)
        .filter(|part| !part.is_empty())
        .collect();
    if parts.len() < 2 {
        return None;
    }
    let mut found: Option<Meaning> = None;
    for part in parts {
        match (whole(part), &mut found) {
            (Some(meaning), None) => found = Some(meaning),
            (Some(meaning), Some(first)) if meaning.column == first.column => {
                if first.unit == HeadingUnit::None {
                    first.unit = meaning.unit;
                }
            }
            (None, Some(first)) if matches!(stated(part, first.column), HeadingUnit::Stated(_)) => {
                first.unit = stated(part, first.column);
            }
            _ => return None,
        }
    }
    found
}

/// A name of the table, without a unit; plurals are names too.
fn named(text: &str) -> Option<Meaning> {
    let key = squashed(text);
    if key.is_empty() {
        return None;
    }
    let singular = || {
        key.strip_suffix('s')
            .filter(|rest| rest.chars().count() > 3)
    };
    // "Storeys" counts them; it does not say on which one an object stands.
    let is_floor =
        |entries: &&Vec<Entry>| entries.iter().any(|entry| entry.column == Column::Floor);
    let entries = TABLE
        .get(&key)
        .or_else(|| TABLE.get(singular()?).filter(|entries| !is_floor(entries)))?;
    // A name that two columns share is the one that is listed first; but German sizes (Maße) have
    // an ß that a mass (Masse) does not.
    let is_sizes = text.contains('ß') || text.contains('ẞ');
    let sizes = entries
        .iter()
        .find(|entry| is_sizes && entry.column == Column::Dimensions);
    let entry = sizes.or(entries.first())?;
    let unit = entry.unit.unwrap_or_default();
    Some(Meaning {
        rank: entry.rank,
        language: entry.language,
        unit: stated(unit, entry.column),
        is_long_side: entry.is_long_side,
        ..Meaning::new(entry.column)
    })
}

/// A name among words that do not change it: `Overall height`, `Weight (est.)`.
fn unqualified(text: &str) -> Option<Meaning> {
    let words = canonical(text);
    let rest: Vec<&str> = words
        .split(' ')
        .filter(|word| !is_among(word, QUALIFIERS))
        .collect();
    if rest.is_empty() || rest.len() == words.split(' ').count() {
        return None;
    }
    let name = rest.join(" ");
    // "Total weight" of a row with a quantity may be that of all its objects.
    if words.contains("total") && named(&name)?.column == Column::Mass {
        return None;
    }
    let mut found = named(&name)?;
    found.rank += 100;
    Some(found)
}

/// The text before a bracket, in it, and after it.
fn bracketed(text: &str) -> Option<(&str, &str, &str)> {
    let open = text.find(['[', '('])?;
    let rest = text.get(open + 1..)?;
    let close = rest.find([']', ')']).unwrap_or(rest.len());
    let after = rest.get(close + 1..).unwrap_or_default();
    let name = text.get(..open)?.trim();
    (!name.is_empty()).then(|| {
        (
            name,
            rest.get(..close).unwrap_or_default().trim(),
            after.trim(),
        )
    })
}

/// `height_mm`, `Height in mm`, `Breite, cm`, `stiffness_n_mm`: the unit follows a known name.
fn suffixed(text: &str) -> Option<Meaning> {
    let places = text
        .char_indices()
        .filter(|(_, c)| !c.is_alphanumeric())
        .map(|(at, c)| (at, at + c.len_utf8()));
    // From the end: the longest name wins.
    places
        .collect::<Vec<_>>()
        .into_iter()
        .rev()
        .find_map(|(end, start)| {
            let mut found = named(text.get(..end)?).or_else(|| unqualified(text.get(..end)?))?;
            let rest = text
                .get(start..)?
                .trim()
                .trim_start_matches(['/', ',', '-', '_', '.', ':'])
                .trim();
            let words = ["in ", "en ", "em ", "IN ", "in_", "IN_"];
            let rest = words
                .iter()
                .find_map(|word| rest.strip_prefix(word))
                .unwrap_or(rest);
            if found.column == Column::Mass
                && squashed(text.get(..end)?) == "masse"
                && order_of(rest).is_some()
            {
                found.column = Column::Dimensions;
            }
            if is_another(&found, rest) {
                return None;
            }
            match stated(rest, found.column) {
                HeadingUnit::Stated(unit) if is_only_unit(rest, found.column) => {
                    found.unit = HeadingUnit::Stated(unit)
                }
                _ if found.column == Column::Dimensions && order_of(rest).is_some() => {}
                _ => return None,
            }
            found.order = order_of(rest);
            Some(found)
        })
}

/// Whether words after a name make it the name of something else: `Height above floor`,
/// `Weight limit`, `Hauteur sous plafond`.
fn is_another(found: &Meaning, words: &str) -> bool {
    const OTHERS: &str = "above below to from under over off limit contents content capacity load loading shelf \
        shelves aisle ceiling clearance door opening floor ground grade cg cog per sous sur plafond sol \
        charge uber unter bis decke boden inhalt sopra sotto soffitto techo suelo teto limite";
    let is_measure = matches!(
        dimension(found.column),
        Some(Dimension::Length | Dimension::Mass)
    );
    let is_gap = matches!(
        found.column,
        Column::WallGap | Column::NeighbourGap | Column::Clearance | Column::CgHeight
    );
    is_measure
        && !is_gap
        && canonical(words)
            .split(' ')
            .any(|word| is_among(word, OTHERS))
}

/// Whether the words after a name are its unit and words that do not change it.
fn is_only_unit(text: &str, column: Column) -> bool {
    let is_whole = dimension(column).is_some_and(|dimension| find(text, dimension).is_ok());
    let words = text
        .split(|c: char| c.is_whitespace() || matches!(c, ',' | ';' | '(' | ')' | '[' | ']' | '_'));
    is_whole
        || words.filter(|word| !word.is_empty()).all(|word| {
            let plain = canonical(word);
            let is_unit = dimension(column).is_some_and(|dimension| find(word, dimension).is_ok());
            is_unit
                || plain.is_empty()
                || is_among(&plain, "in en em each gross net full empty x")
                || is_among(&plain, QUALIFIERS)
                || order_of(text).is_some()
        })
}

/// The dimension of the numbers of a column; `None`: its cells have no unit.
pub(super) fn dimension(column: Column) -> Option<Dimension> {
    match COLUMNS.get(column as usize)?.holds {
        Holds::Quantity(dimension) => Some(dimension),
        Holds::Sizes => Some(Dimension::Length),
        _ => None,
    }
}

/// The unit that a bracket states; words such as `overall` state none.
fn stated(text: &str, column: Column) -> HeadingUnit {
    let Some(dimension) = dimension(column) else {
        return HeadingUnit::None;
    };
    if text.is_empty() {
        return HeadingUnit::None;
    }
    if dimension == Dimension::Ratio {
        // The brackets of a ratio say what it is a ratio of.
        return find(text, dimension).map_or(HeadingUnit::None, HeadingUnit::Stated);
    }
    let whole = find(text, dimension);
    if let Ok(unit) = whole {
        return HeadingUnit::Stated(unit);
    }
    let parts: Vec<Result<CellUnit, NoUnit>> = text
        .split([',', ';', ' '])
        .map(str::trim)
        .filter(|part| !part.is_empty())
        .map(|part| find(part, dimension))
        .collect();
    let units: Vec<CellUnit> = parts.iter().flatten().copied().collect();
    match units.as_slice() {
        // "in" alone among words may be a preposition.
        [unit] if unit.symbol() != "in" => return HeadingUnit::Stated(*unit),
        // "in cm" and "in inches": the first is the preposition.
        [first, unit]
            if first.symbol() == "in"
                && text
                    .get(..2)
                    .is_some_and(|two| two.eq_ignore_ascii_case("in")) =>
        {
            return HeadingUnit::Stated(*unit);
        }
        [_, ..] => return HeadingUnit::Wrong(text.to_owned()),
        [] => {}
    }
    // One short word that says nothing known is probably a unit that is not known here.
    let words = canonical(text);
    let is_word = !words.contains(' ') && (1..=8).contains(&words.chars().count());
    let is_order = order_of(text).is_some();
    let is_known = is_among(&words, QUALIFIERS)
        || named(text).is_some()
        || is_among(&words, "each gross net full empty opt optional");
    if matches!(whole, Err(NoUnit::Other(_))) || is_word && !is_order && !is_known {
        HeadingUnit::Wrong(text.to_owned())
    } else {
        HeadingUnit::None
    }
}

/// The order of sizes in `H x W x D`, `BxTxH`, `L×l×H`: letters, lower-case where two are alike.
pub(super) fn order_of(text: &str) -> Option<Vec<char>> {
    let head: String = plain(text);
    let mut order = Vec::new();
    for part in head
        .split(['x', 'X', '×', '*', '/'])
        .map(str::trim)
        .filter(|part| !part.is_empty())
    {
        let word = part.split(' ').next().unwrap_or_default();
        let letter = match canonical(word).as_str() {
            "h" | "height" | "hohe" | "hauteur" | "a" | "alto" | "altura" | "altezza"
            | "yukseklik" | "y" | "高さ" | "高" => 'H',
            "w" | "width" | "b" | "breite" | "ancho" | "largeur" | "larghezza" | "largura"
            | "genislik" | "g" | "宽" | "幅" => 'W',
            "l" | "length" | "lange" | "longueur" | "largo" | "lunghezza" | "長さ" | "长" => 'L',
            "d" | "depth" | "t" | "tiefe" | "p" | "profondeur" | "profundidad" | "profondita"
            | "f" | "fondo" | "derinlik" | "profundidade" | "深" | "奥行" => 'D',
            _ => return None,
        };
        order.push(letter);
    }
    // Of two lengths the first is the long side, the second the width: L x l x H.
    if order.iter().filter(|letter| **letter == 'L').count() == 2
        && let Some(second) = order.iter().rposition(|letter| *letter == 'L')
        && let Some(slot) = order.get_mut(second)
    {
        *slot = 'W';
    }
    let is_complete =
        order.len() == 3 && order.contains(&'H') || order.len() == 2 && !order.contains(&'H');
    let mut distinct = order.clone();
    distinct.sort_unstable();
    distinct.dedup();
    (is_complete && distinct.len() == order.len()).then_some(order)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Option<(Column, Option<&'static str>)> {
        let found = meaning(text)?;
        match found.unit {
            HeadingUnit::None => Some((found.column, None)),
            HeadingUnit::Stated(unit) => Some((found.column, Some(unit.symbol()))),
            HeadingUnit::Wrong(text) => panic!("{text}"),
        }
    }

    #[test]
    fn headings_are_recognised_with_their_units() {
        for (text, column, unit) in [
            ("Height [mm]", Column::Height, Some("mm")),
            ("HEIGHT_MM", Column::Height, Some("mm")),
            ("Height, cm", Column::Height, Some("cm")),
            ("Height in mm", Column::Height, Some("mm")),
            ("Overall Height (m)", Column::Height, Some("m")),
            ("Höhe（mm）", Column::Height, Some("mm")),
            ("Höhe / Height (mm)", Column::Height, Some("mm")),
            ("Height / mm", Column::Height, Some("mm")),
            ("Hauteur en cm", Column::Height, Some("cm")),
            ("高さ(mm)", Column::Height, Some("mm")),
            ("Breite, cm", Column::Width, Some("cm")),
            ("Depths", Column::Thickness, None),
            ("WEIGHT_KG", Column::Mass, Some("kg")),
            ("Weight (kN)", Column::Mass, Some("kN")),
            ("Weight (kg, full)", Column::Mass, Some("kg")),
            ("stiffness_n_mm", Column::Stiffness, Some("N/mm")),
            ("allowable g", Column::Tolerance, Some("g")),
            ("Max shock (g)", Column::Tolerance, Some("g")),
            ("tol. duration [ms]", Column::ToleranceDuration, Some("ms")),
            ("c.g. height (mm)", Column::CgHeight, Some("mm")),
            ("Inv.-Nr.", Column::Id, None),
            ("N° d’inventaire", Column::Id, None),
            ("Life safety (LS)", Column::LifeSafety, None),
            ("Nonstructural Item", Column::Item, None),
            ("Q.tà", Column::Quantity, None),
            ("No. off", Column::Quantity, None),
            ("Fixé (au mur)", Column::Anchored, None),
            ("Level ratio (0 ground, 1 roof)", Column::LevelRatio, None),
            ("Dimensions (HxWxD) mm", Column::Dimensions, Some("mm")),
            ("階", Column::Floor, None),
            ("Maße (mm)", Column::Dimensions, Some("mm")),
            ("Masse (kg)", Column::Mass, Some("kg")),
            ("Masse (cm)", Column::Dimensions, Some("cm")),
            ("kg", Column::Mass, Some("kg")),
            ("Castors", Column::Casters, None),
            ("Wheels?", Column::Casters, None),
            ("Rollen", Column::Casters, None),
            ("Ø (mm)", Column::Diameter, Some("mm")),
            ("Dimensions H x W x D", Column::Dimensions, None),
            ("Dimensions HxWxD mm", Column::Dimensions, Some("mm")),
            ("H x W x D (cm)", Column::Dimensions, Some("cm")),
            ("Yükseklik (cm)", Column::Height, Some("cm")),
            ("Ağırlık (kg)", Column::Mass, Some("kg")),
            ("Sabit mi?", Column::Anchored, None),
            ("Duvara mesafe (cm)", Column::WallGap, Some("cm")),
            ("Demirbaş No", Column::Id, None),
            ("Largura (cm)", Column::Width, Some("cm")),
            ("楼层", Column::Floor, None),
            ("高度(mm)", Column::Height, Some("mm")),
        ] {
            assert_eq!(read(text), Some((column, unit)), "{text}");
        }
        for text in [
            "",
            "Floor type",
            "Mounting height",
            "Height above floor",
            "Height above floor (mm)",
            "Height (above floor)",
            "Height mm above floor",
            "Height to cg (mm)",
            "Height_to_cg mm",
            "Height (to cg), mm",
            "Hauteur sous plafond (mm)",
            "Weight limit (kg)",
            "Weight (limit) kg",
            "Mass of contents (kg)",
            "Depth below grade (m)",
            "Storeys",
            "Floors",
            "Shelf width",
            "Floor/Room",
            "Total weight (kg)",
            "Make/Model",
            "Area (m2)",
            "12",
        ] {
            assert_eq!(read(text), None, "{text}");
        }
        for text in ["Height (kg)", "Weight (stone)", "Height (cubits)"] {
            assert!(
                matches!(
                    meaning(text).map(|found| found.unit),
                    Some(HeadingUnit::Wrong(_))
                ),
                "{text}"
            );
        }
    }

    #[test]
    fn orders_of_sizes() {
        assert_eq!(order_of("H x W x D"), Some(vec!['H', 'W', 'D']));
        assert_eq!(order_of("BxTxH mm"), Some(vec!['W', 'D', 'H']));
        assert_eq!(order_of("L×l×H"), Some(vec!['L', 'W', 'H']));
        for text in [
            "Dimensions H x W x D",
            "Dimensions HxWxD mm",
            "H x W x D (cm)",
            "Size (mm) HxWxD",
        ] {
            assert_eq!(
                meaning(text).unwrap().order,
                Some(vec!['H', 'W', 'D']),
                "{text}"
            );
        }
        assert_eq!(order_of("mm"), None);
        assert_eq!(order_of("HxH"), None);
    }

    #[test]
    fn every_column_but_those_that_are_only_ours_has_headings() {
        for spec in &COLUMNS {
            assert_eq!(
                meaning(spec.name).map(|found| found.column),
                Some(spec.column),
                "{}",
                spec.name
            );
        }
    }
}
