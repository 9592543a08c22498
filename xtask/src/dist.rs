//! What is given to people without Rust: an archive, a Debian package, a list of what is inside, and
//! checksums. Each is unpacked or installed in an empty folder and run there.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::{Value, json};
use sha2::{Digest, Sha256};

use crate::python::published_program;
use crate::tools::{ended, run, told};

/// Where the program itself is, in the workspace.
const PROGRAM: &str = "crates/freestand-cli";
/// What is inside the page that the program hands out.
const PAGE: &str = "crates/freestand-page/ui/package-lock.json";
/// Files that lie beside the program.
const DOCUMENTS: [&str; 6] = [
    "README.md",
    "CHANGELOG.md",
    "CITATION.cff",
    "SECURITY.md",
    "LICENSE-APACHE",
    "LICENSE-MIT",
];
/// A question whose answer shows that the program works.
const QUESTION: [&str; 8] = [
    "object",
    "--height",
    "2 m",
    "--thickness",
    "0.4 m",
    "--place",
    "Wellington",
    "--json",
];

/// Builds everything into a folder.
pub fn dist(root: &Path, out: &Path) -> Result<(), String> {
    let metadata = metadata(root)?;
    let version = text(&metadata["version"]);
    let host = host(root)?;
    run(root, "cargo", &published_program())?;
    let target = PathBuf::from(text(&metadata["target"])).join("published");
    let program = target.join(format!("freestand{}", std::env::consts::EXE_SUFFIX));
    fs::create_dir_all(out).map_err(told(out))?;
    let staged = Staged::new(out)?;
    let name = format!("freestand-{version}-{host}");
    let folder = staged.0.join(&name);
    let parts = Parts::of(&metadata["tree"])?;
    lay_out(root, &program, &folder)?;
    // Debian looks for the licences in `copyright`.
    let notices_file = folder.join("share/doc/freestand/copyright");
    fs::write(&notices_file, notices(root, &parts)?).map_err(told(&notices_file))?;

    let seconds = seconds_of_commit(root);
    let mut made = vec![archive(&staged.0, &name, out, seconds)?];
    if cfg!(target_os = "linux") && exists("dpkg-deb") {
        made.push(debian(&staged.0, &folder, &version, &host, out, seconds)?);
    } else {
        println!("skipped: no Debian package without dpkg-deb");
    }
    let bill = out.join(format!("freestand-{version}.cdx.json"));
    let contents = bill_of_materials(root, &parts)?;
    fs::write(&bill, contents).map_err(told(&bill))?;
    made.push(bill);
    let sums: Result<String, String> = made.iter().map(|path| checksum(path)).collect();
    let path = out.join("SHA256SUMS");
    fs::write(&path, sums?).map_err(told(&path))?;
    for path in made.iter().chain([&path]) {
        let bytes = fs::metadata(path).map_or(0, |data| data.len());
        println!("{}, {:.1} MB", path.display(), bytes as f64 / 1e6);
    }
    Ok(())
}

/// A folder that is gone when the work is.
struct Staged(PathBuf);

impl Staged {
    fn new(out: &Path) -> Result<Self, String> {
        let folder = out.join(".staged");
        if folder.exists() {
            fs::remove_dir_all(&folder).map_err(told(&folder))?;
        }
        fs::create_dir_all(&folder).map_err(told(&folder))?;
        Ok(Self(folder))
    }
}

impl Drop for Staged {
    fn drop(&mut self) {
        _ = fs::remove_dir_all(&self.0);
    }
}

/// The folders of a prefix such as /usr: the program, its manual, what shells complete, and the entry of a desktop.
fn lay_out(root: &Path, program: &Path, prefix: &Path) -> Result<(), String> {
    let copied = [
        (
            program.to_owned(),
            format!("bin/freestand{}", std::env::consts::EXE_SUFFIX),
        ),
        (
            root.join("xtask/dist/freestand.desktop"),
            "share/applications/freestand.desktop".to_owned(),
        ),
        (
            root.join("xtask/dist/freestand.svg"),
            "share/icons/hicolor/scalable/apps/freestand.svg".to_owned(),
        ),
    ];
    let documents = DOCUMENTS.map(|name| (root.join(name), format!("share/doc/freestand/{name}")));
    for (from, to) in copied.into_iter().chain(documents) {
        let to = prefix.join(to);
        in_folder(&to)?;
        fs::copy(&from, &to).map_err(told(&from))?;
    }
    for (shell, to) in [
        ("bash", "share/bash-completion/completions/freestand"),
        ("fish", "share/fish/vendor_completions.d/freestand.fish"),
        ("zsh", "share/zsh/site-functions/_freestand"),
    ] {
        let to = prefix.join(to);
        in_folder(&to)?;
        let script = asked(program, &["completions", shell])?;
        fs::write(&to, script).map_err(told(&to))?;
    }
    let pages = prefix.join("manual");
    asked(
        program,
        &["manual", "--quiet", "--out", &pages.to_string_lossy()],
    )?;
    let manual = prefix.join("share/man/man1");
    fs::create_dir_all(&manual).map_err(told(&manual))?;
    for page in fs::read_dir(&pages).map_err(told(&pages))?.flatten() {
        let name = page.file_name();
        if Path::new(&name)
            .extension()
            .is_some_and(|ending| ending == "1")
        {
            fs::copy(page.path(), manual.join(name)).map_err(told(&manual))?;
        }
    }
    fs::remove_dir_all(&pages).map_err(told(&pages))
}

/// The archive, unpacked again and asked.
fn archive(staged: &Path, name: &str, out: &Path, seconds: u64) -> Result<PathBuf, String> {
    let path = out.join(format!("{name}.tar.gz"));
    let file = path.to_string_lossy().into_owned();
    // Equal inputs give equal bytes.
    let time = format!("--mtime=@{seconds}");
    let same = [
        "--sort=name",
        "--owner=0",
        "--group=0",
        "--numeric-owner",
        &time,
    ];
    let same = if cfg!(target_os = "linux") {
        &same[..]
    } else {
        &[]
    };
    run(staged, "tar", &[same, &["-czf", &file, name]].concat())?;
    let tried = staged.join("tried");
    fs::create_dir_all(&tried).map_err(told(&tried))?;
    run(&tried, "tar", &["-xzf", &file])?;
    answers(&tried.join(name).join("bin/freestand"))?;
    Ok(path)
}

/// The Debian package, installed in an empty root, asked, and removed without a trace.
fn debian(
    staged: &Path,
    folder: &Path,
    version: &str,
    host: &str,
    out: &Path,
    seconds: u64,
) -> Result<PathBuf, String> {
    let architecture = match host.split('-').next() {
        Some("x86_64") => "amd64",
        Some("aarch64") => "arm64",
        other => other.unwrap_or_default(),
    };
    let package = staged.join("debian");
    let control = package.join("DEBIAN/control");
    in_folder(&control)?;
    let usr = package.join("usr");
    fs::rename(folder, &usr).map_err(told(&usr))?;
    let libc = newest_libc(&usr.join("bin/freestand"))?;
    let written = format!(
        "Package: freestand\nVersion: {version}\nArchitecture: {architecture}\nMaintainer: The freestand contributors \
         <noreply@freestand.invalid>\nDepends: libc6 (>= {libc}), libgcc-s1\nSection: science\nPriority: optional\n\
         Installed-Size: {}\nDescription: whether an earthquake makes a free-standing object fall\n Says how hard an \
         earthquake knocks cabinets, racks, equipment and\n exhibits that stand on the floor, and whether they fall over. \
         The command\n \"freestand serve\" opens its page in a browser, without a network.\n",
        size(&usr)?.div_ceil(1024)
    );
    fs::write(&control, written).map_err(told(&control))?;
    let path = out.join(format!("freestand_{version}_{architecture}.deb"));
    let file = path.to_string_lossy().into_owned();
    let build = ["--root-owner-group", "-Zxz", "--build", "debian", &file];
    let built = Command::new("dpkg-deb")
        .args(build)
        .current_dir(staged)
        .env("SOURCE_DATE_EPOCH", seconds.to_string())
        .output();
    ended("dpkg-deb", built)?;

    let root = staged.join("root");
    for part in [
        "var/lib/dpkg/info",
        "var/lib/dpkg/updates",
        "var/lib/dpkg/triggers",
        "var/log",
    ] {
        fs::create_dir_all(root.join(part)).map_err(told(&root))?;
    }
    let status = root.join("var/lib/dpkg/status");
    fs::write(&status, "").map_err(told(&status))?;
    let database = format!("--root={}", root.display());
    // The root has no libc of its own, so the program runs with that of this machine.
    let force = [
        "--force-not-root",
        "--force-depends",
        "--force-script-chrootless",
    ];
    let dpkg = |rest: &[&str]| {
        let log = format!("--log={}", root.join("var/log/dpkg.log").display());
        let all = [&[&*database, &*log][..], &force, rest].concat();
        ended(
            "dpkg",
            Command::new("dpkg")
                .args(all)
                .env("PATH", path_with_sbin())
                .output(),
        )
    };
    dpkg(&["--install", &file])?;
    answers(&root.join("usr/bin/freestand"))?;
    dpkg(&["--purge", "freestand"])?;
    if root.join("usr").exists() {
        return Err("the package left files behind when it was removed".to_owned());
    }
    Ok(path)
}

/// dpkg wants the tools of the administrator.
fn path_with_sbin() -> String {
    format!(
        "{}:/usr/sbin:/sbin",
        std::env::var("PATH").unwrap_or_default()
    )
}

/// Asks a program something, without anything of this environment.
fn answers(program: &Path) -> Result<(), String> {
    let answer = ended(
        &program.to_string_lossy(),
        Command::new(program).args(QUESTION).env_clear().output(),
    )?;
    let answer: Value = serde_json::from_slice(&answer)
        .map_err(|error| format!("{}: {error}", program.display()))?;
    match answer["answer"].as_str() {
        Some(answer) => {
            println!("{}: {answer}", program.display());
            Ok(())
        }
        None => Err(format!("{} does not answer", program.display())),
    }
}

/// The newest version of the C library that a program names, such as 2.34.
fn newest_libc(program: &Path) -> Result<String, String> {
    const NAME: &[u8] = b"GLIBC_2.";
    let bytes = fs::read(program).map_err(told(program))?;
    let minor = |place: usize| {
        let digits = bytes
            .get(place..)?
            .iter()
            .take_while(|byte| byte.is_ascii_digit());
        digits
            .map(|byte| char::from(*byte))
            .collect::<String>()
            .parse::<u32>()
            .ok()
    };
    let found = bytes.windows(NAME.len()).enumerate();
    let newest = found
        .filter_map(|(at, one)| (one == NAME).then(|| minor(at + NAME.len()))?)
        .max();
    newest
        .map(|minor| format!("2.{minor}"))
        .ok_or_else(|| format!("{}: it names no C library", program.display()))
}

/// The crates that the program is made of.
struct Parts<'a> {
    packages: BTreeMap<&'a str, &'a Value>,
    nodes: BTreeMap<&'a str, &'a Value>,
    own: &'a str,
    seen: BTreeSet<&'a str>,
}

impl<'a> Parts<'a> {
    fn of(tree: &'a Value) -> Result<Self, String> {
        let by_id = |list: &'a Value| -> BTreeMap<&'a str, &'a Value> {
            let all = list.as_array().into_iter().flatten();
            all.map(|one| (one["id"].as_str().unwrap_or_default(), one))
                .collect()
        };
        let packages = by_id(&tree["packages"]);
        let own = packages
            .iter()
            .find(|(_, package)| package["name"] == "freestand-cli");
        let own = *own.ok_or("the program is not among the packages")?.0;
        let mut parts = Self {
            packages,
            nodes: by_id(&tree["resolve"]["nodes"]),
            own,
            seen: BTreeSet::new(),
        };
        let mut next = vec![own];
        while let Some(id) = next.pop() {
            if parts.seen.insert(id) {
                next.extend(parts.below(id));
            }
        }
        Ok(parts)
    }

    /// What goes into a crate.
    fn below(&self, id: &str) -> Vec<&'a str> {
        let dependencies = self.nodes.get(id).and_then(|node| node["deps"].as_array());
        let goes_in = |dependency: &&Value| {
            let kinds = dependency["dep_kinds"].as_array();
            kinds.is_some_and(|kinds| kinds.iter().any(|kind| kind["kind"].is_null()))
        };
        let dependencies = dependencies.into_iter().flatten().filter(goes_in);
        dependencies
            .filter_map(|dependency| dependency["pkg"].as_str())
            .collect()
    }

    fn package(&self, id: &str) -> &'a Value {
        self.packages.get(id).copied().unwrap_or(&Value::Null)
    }

    /// Name, version and licence of a crate; the licence as an expression.
    fn named(&self, id: &str) -> [String; 3] {
        let package = self.package(id);
        // An old way to write OR.
        let license = text(&package["license"])
            .replace(" / ", " OR ")
            .replace('/', " OR ");
        [text(&package["name"]), text(&package["version"]), license]
    }
}

/// The folder of the font of figures, with its licence.
const FONT: &str = "crates/freestand-output/src/figure/font";

/// The licences of everything that goes into the program, each text once, with what it is of: most licences ask for
/// it wherever a program is handed on.
fn notices(root: &Path, parts: &Parts<'_>) -> Result<String, String> {
    let mut told =
        "The licences of what goes into freestand, which is itself under MIT OR Apache-2.0.\n\n"
            .to_owned();
    let mut texts: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let mut add = |name: String, folder: &Path| -> Result<(), String> {
        for path in fs::read_dir(folder).into_iter().flatten().flatten() {
            let file = path.file_name().to_string_lossy().to_ascii_uppercase();
            let is_one = ["LICENSE", "LICENCE", "COPYING", "NOTICE", "UNLICENSE"];
            if is_one.iter().any(|begin| file.starts_with(begin)) && path.path().is_file() {
                let text = fs::read(path.path()).map_err(self::told(folder))?;
                let text = String::from_utf8_lossy(&text).trim().replace('\r', "");
                texts.entry(text).or_default().push(name.clone());
            }
        }
        Ok(())
    };
    for id in parts.seen.iter().filter(|id| **id != parts.own) {
        let [name, version, license] = parts.named(id);
        let manifest = text(&parts.package(id)["manifest_path"]);
        let folder = Path::new(&manifest).parent().unwrap_or(root);
        if folder.starts_with(root.join("crates")) {
            continue;
        }
        told += &format!("{name} {version}: {license}\n");
        add(format!("{name} {version}"), folder)?;
    }
    for (path, package) in of_page(root)? {
        let name = path.rsplit("node_modules/").next().unwrap_or(&path);
        told += &format!(
            "{name} {}: {}\n",
            text(&package["version"]),
            text(&package["license"])
        );
        let folder = root.join(PAGE).with_file_name("").join(&path);
        add(format!("{name} {}", text(&package["version"])), &folder)?;
    }
    told += "DejaVu Sans 2.37: Bitstream Vera and public domain\n";
    add("DejaVu Sans 2.37".to_owned(), &root.join(FONT))?;
    for (text, names) in texts {
        told += &format!("\n{}\n{}:\n\n{text}\n", "-".repeat(72), names.join(", "));
    }
    Ok(told)
}

/// The packages that go into the page, by their paths.
fn of_page(root: &Path) -> Result<Vec<(String, Value)>, String> {
    let page = root.join(PAGE);
    let page: Value = serde_json::from_slice(&fs::read(&page).map_err(told(&page))?)
        .map_err(|error| format!("{}: {error}", page.display()))?;
    let all = page["packages"].as_object().into_iter().flatten();
    let goes_in = all.filter(|(name, one)| !name.is_empty() && one["dev"] != true);
    Ok(goes_in
        .map(|(path, one)| (path.clone(), one.clone()))
        .collect())
}

/// Every crate of the program and every package of its page, as a bill of materials (CycloneDX 1.5).
fn bill_of_materials(root: &Path, parts: &Parts<'_>) -> Result<Vec<u8>, String> {
    let lock = root.join("Cargo.lock");
    let sums = fs::read_to_string(&lock).map_err(told(&lock))?;
    let sums: BTreeMap<(String, String), String> = sums
        .split("[[package]]")
        .filter_map(|package| {
            let value = |key: &str| {
                let line = package.lines().find_map(|line| line.strip_prefix(key))?;
                Some(line.trim_start_matches(" = ").trim_matches('"').to_owned())
            };
            Some(((value("name")?, value("version")?), value("checksum")?))
        })
        .collect();
    let reference = |id: &str| {
        let [name, version, _] = parts.named(id);
        format!("pkg:cargo/{name}@{version}")
    };
    let crates = parts.seen.iter().filter(|id| **id != parts.own).map(|id| {
        let [name, version, license] = parts.named(id);
        let mut one = json!({"type": "library", "bom-ref": reference(id), "name": name, "version": version,
            "purl": reference(id), "licenses": [{"expression": license}]});
        if let Some(sum) = sums.get(&(name, version)) {
            one["hashes"] = json!([{"alg": "SHA-256", "content": sum}]);
        }
        one
    });
    let page = of_page(root)?;
    let page = page.iter().map(|(path, one)| {
        let name = path.rsplit("node_modules/").next().unwrap_or(path);
        let reference = format!("pkg:npm/{}@{}", name.replace('@', "%40"), text(&one["version"]));
        json!({"type": "library", "bom-ref": reference, "name": name, "version": one["version"], "purl": reference,
            "licenses": [{"expression": one["license"]}]})
    });
    let components: Vec<Value> = crates.chain(page).collect();
    let dependencies = parts.seen.iter().map(|id| {
        let below: BTreeSet<String> = parts.below(id).into_iter().map(reference).collect();
        json!({"ref": reference(id), "dependsOn": below})
    });
    let [_, version, _] = parts.named(parts.own);
    let document = json!({
        "bomFormat": "CycloneDX",
        "specVersion": "1.5",
        "version": 1,
        "metadata": {"component": {"type": "application", "bom-ref": reference(parts.own), "name": "freestand",
            "version": version, "licenses": [{"expression": "MIT OR Apache-2.0"}]}},
        "components": components,
        "dependencies": dependencies.collect::<Vec<_>>(),
    });
    let mut bytes = serde_json::to_vec_pretty(&document).map_err(|error| error.to_string())?;
    bytes.push(b'\n');
    Ok(bytes)
}

/// A line of SHA256SUMS.
fn checksum(path: &Path) -> Result<String, String> {
    let sum = Sha256::digest(fs::read(path).map_err(told(path))?);
    let sum: String = sum.iter().map(|byte| format!("{byte:02x}")).collect();
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    Ok(format!("{sum}  {name}\n"))
}

/// What cargo knows of the workspace: its version, its target folder, and its packages for this machine.
fn metadata(root: &Path) -> Result<Value, String> {
    let host = host(root)?;
    let arguments = [
        "metadata",
        "--format-version=1",
        "--locked",
        "--filter-platform",
        &host,
    ];
    let output = Command::new("cargo")
        .args(arguments)
        .current_dir(root)
        .output();
    let tree: Value = serde_json::from_slice(&ended("cargo metadata", output)?)
        .map_err(|error| format!("cargo metadata: {error}"))?;
    let own = tree["packages"].as_array().into_iter().flatten();
    let own = own.clone().find(|package| {
        package["manifest_path"]
            .as_str()
            .is_some_and(|path| Path::new(path).starts_with(root.join(PROGRAM)))
    });
    let version = own
        .map(|package| package["version"].clone())
        .unwrap_or_default();
    Ok(json!({"version": version, "target": tree["target_directory"].clone(), "tree": tree}))
}

/// The name of this kind of machine, such as x86_64-unknown-linux-gnu.
fn host(root: &Path) -> Result<String, String> {
    let output = Command::new("rustc").arg("-vV").current_dir(root).output();
    let told = String::from_utf8_lossy(&ended("rustc -vV", output)?).into_owned();
    let line = told.lines().find_map(|line| line.strip_prefix("host: "));
    line.map(str::to_owned)
        .ok_or_else(|| "rustc -vV names no host".to_owned())
}

/// The time of the last commit, so that equal sources give equal files; 0 outside a repository \[s\].
fn seconds_of_commit(root: &Path) -> u64 {
    let output = Command::new("git")
        .args(["log", "-1", "--format=%ct"])
        .current_dir(root)
        .output();
    let seconds = output
        .ok()
        .and_then(|output| String::from_utf8(output.stdout).ok());
    seconds
        .and_then(|text| text.trim().parse().ok())
        .unwrap_or(0)
}

fn exists(program: &str) -> bool {
    Command::new(program).arg("--version").output().is_ok()
}

fn size(folder: &Path) -> Result<u64, String> {
    let mut bytes = 0;
    for entry in fs::read_dir(folder).map_err(told(folder))?.flatten() {
        let data = entry.metadata().map_err(told(folder))?;
        bytes += if data.is_dir() {
            size(&entry.path())?
        } else {
            data.len()
        };
    }
    Ok(bytes)
}

fn in_folder(path: &Path) -> Result<(), String> {
    path.parent().map_or(Ok(()), |folder| {
        fs::create_dir_all(folder).map_err(told(folder))
    })
}

fn asked(program: &Path, arguments: &[&str]) -> Result<Vec<u8>, String> {
    ended(
        &program.to_string_lossy(),
        Command::new(program).args(arguments).output(),
    )
}

fn text(value: &Value) -> String {
    value.as_str().unwrap_or_default().to_owned()
}
