use std::time::Instant;
fn main(){
    let t=asperity::builtin::texture();
    for _ in 0..3 {
        let a=Instant::now(); let l=asperity::lower::lower(&t,None).unwrap(); let b=Instant::now();
        asperity::verify::verify(&t,&l.bytes).unwrap(); let c=Instant::now();
        let r=asperity::reduce::reduce(&t.grid,asperity::reduce::Fidelity::Auto); let d=Instant::now();
        let p=asperity::preview::png(&t.grid,&[("abrasives",1.0)],0).unwrap(); let e=Instant::now();
        let _=asperity::attributes::of(&t); let f=Instant::now();
        println!("lower {:?} verify {:?} reduce {:?} (order {} {:.3} dB) preview {:?} {} attr {:?}",b-a,c-b,d-c,r.0.order,r.1,e-d,p.len(),f-e);
        std::fs::write("/tmp/prev.png",p).unwrap();
    }
    let back=asperity::inference::Backend::Portable;
    let a=Instant::now(); let te=asperity::embedded::text_encoder(&back).unwrap(); println!("load text {:?}",a.elapsed());
    use asperity::text::TextEncoder;
    for p in ["rough abrasive sheet with gritty particles","Wet ice!","Ünïcode café №5"] { let a=Instant::now(); let e=te.encode(p).unwrap(); println!("{:?} {} tokens {:?}",a.elapsed(),e.tokens,&e.vector[..4]); }
    let long="gravel ".repeat(300); let a=Instant::now(); let e=te.encode(&long).unwrap(); println!("{:?} {} {}",a.elapsed(),e.tokens,e.cut);
}
