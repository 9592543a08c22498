//! The built-in study as a whole, without writing its files.

#![expect(clippy::unwrap_used, reason = "a benchmark may stop")]

use criterion::{Criterion, criterion_group, criterion_main};
use freestand_study::resolve::{Overrides, builtin};
use freestand_study::run::{no_progress, run};

fn built_in_study(criterion: &mut Criterion) {
    let study = builtin(&Overrides::default()).unwrap();
    let mut group =
        criterion.benchmark_group("built-in study: 10 motions x 2 levels x 130 objects");
    group.sample_size(10);
    group.bench_function("run", |bencher| {
        bencher.iter(|| run(&study, &no_progress).unwrap())
    });
    group.finish();
}

criterion_group!(benches, built_in_study);
criterion_main!(benches);
