use drypoint_reference::volume_stippling::try_points;
use drypoint_scene::glam::DVec3;
fn nn(p: &[[f64;2]], lo:f64, hi:f64)->f64 { // mean nn * sqrt density inside window
    let cell=0.25; let n=((hi-lo+8.0)/cell) as usize+1; let mut g=vec![vec![];n*n];
    let ix=|v:f64| (((v-lo+4.0)/cell).max(0.0) as usize).min(n-1);
    for (i,q) in p.iter().enumerate(){ g[ix(q[1])*n+ix(q[0])].push(i); }
    let (mut s,mut c)=(0.0,0.0);
    for (i,q) in p.iter().enumerate(){ if q.iter().any(|&v| v<lo||v>hi){continue;}
        let (a,b)=(ix(q[0]) as i64,ix(q[1]) as i64); let mut best=f64::MAX;
        for r in 0..40i64 { if best.sqrt()<(r-1) as f64*cell {break;}
            for y in b-r..=b+r { for x in a-r..=a+r { if (x-a).abs().max((y-b).abs())!=r||x<0||y<0||x>=n as i64||y>=n as i64{continue;}
                for &j in &g[(y*n as i64+x) as usize]{ if j!=i { let d=(p[j][0]-q[0]).powi(2)+(p[j][1]-q[1]).powi(2); if d<best{best=d;} } } } } }
        s+=best.sqrt(); c+=1.0; }
    s/c*(c/(hi-lo).powi(2)).sqrt()
}
fn spectrum(p:&[[f64;2]],lo:f64,l:f64)->(f64,f64){
    let pts:Vec<_>=p.iter().filter(|q| q.iter().all(|&v| v>=lo&&v<lo+l)).collect();
    let n=pts.len() as f64; let rho=n/l/l; let fmax=0.5*(2.0*rho/3f64.sqrt()).sqrt();
    let top=(2.0*fmax).max(2.2).min(4.0); let m=(top*l) as i64;
    let (mut low,mut nl,mut peak)=(0.0,0.0,0f64);
    let tau=std::f64::consts::TAU;
    let ex:Vec<(f64,f64)>=pts.iter().map(|q|(tau*(q[0]-lo)/l).sin_cos()).collect();
    let ey:Vec<(f64,f64)>=pts.iter().map(|q|(tau*(q[1]-lo)/l).sin_cos()).collect();
    for j in 0..=m { 
        let mut cur:Vec<(f64,f64)>=pts.iter().map(|q|{let t=tau*((q[1]-lo)/l*j as f64-(q[0]-lo)/l*m as f64);(t.cos(),t.sin())}).collect();
        let _=&ey;
        for i in -m..=m { 
            let (mut re,mut im)=(0.0,0.0);
            for (c,e) in cur.iter_mut().zip(&ex){ re+=c.0;im+=c.1; let t=(c.0*e.1-c.1*e.0,c.0*e.0+c.1*e.1); *c=t; }
            if j==0&&i<=0 {continue;}
            let f=((i*i+j*j) as f64).sqrt()/l; if f>top {continue;}
            let pw=(re*re+im*im)/n; if f<=fmax {low+=pw;nl+=1.0;} peak=peak.max(pw);
        } }
    (10.0*(low/nl).log10(),10.0*peak.log10())
}
fn main(){
    let each=25;
    for slab in [0.0,0.5] {
    for (name,nrm) in [("axis",DVec3::Z),("123",DVec3::new(1.,2.,3.).normalize())] {
        let mut cells=vec![];
        for z in 0..80u32 { for y in 0..48u32 { for x in 0..48u32 {
            let zz= if name=="axis" {10} else { (45.0 - (x as f64+2.0*y as f64)/3.0).round() as i64 as u32 };
            if z==zz {cells.push([x,y,z]);} } } }
        let normals=vec![nrm;cells.len()];
        let t=std::time::Instant::now();
        let pts=try_points(&cells,&normals,slab,each,true);
        let dt=t.elapsed().as_secs_f64();
        println!("{name} slab {slab} {} pts {:.3}s {:.2}us/pt",pts.len(),dt,dt*1e6/pts.len() as f64);
        let u=if name=="axis"{DVec3::X}else{nrm.cross(DVec3::X).normalize()}; let v=nrm.cross(u);
        let c=DVec3::new(23.5,23.5,if name=="axis"{10.0}else{45.0-23.5});
        for k in [1,2,4,8,16,25] {
            let mut p=vec![];
            for (i,cell) in cells.iter().enumerate(){ for o in &pts[i*each..i*each+k]{ let w=DVec3::from_array(cell.map(f64::from))+DVec3::from_array(o.map(f64::from))-c; p.push([w.dot(u),w.dot(v)]); } }
            let h=if name=="axis"{24.0}else{17.0};
            let s=if k>4 {h*0.5}else{h};
            let (lo,pk)=spectrum(&p,-s,2.0*s);
            println!(" k={k}: nn {:.3} low {:.1} dB peak {:.1} dB",nn(&p,-h+1.0,h-1.0),lo,pk);
        }
    }}
}
